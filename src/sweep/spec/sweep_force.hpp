#pragma once
// The force of a sweep: a stimulus, whose parameters may vary between items, or one channel of a recording.

#include <map>
#include <memory>
#include <mutex>

#include "core/force_source.hpp"
#include "core/parameter_override.hpp"
#include "sweep/spec/axis.hpp"

namespace corpuscle::sweeps {

/// One complete force.
struct SweepForce {
    std::vector<double> samples;  ///< N
    Clock clock;                  ///< the first sample is at 0 s, also that of a recording
    std::vector<Phase> phases;
    double cycle_frequency = 0;  ///< Hz; 0 if the force is not periodic

    /// Duration, s.
    double end() const { return static_cast<double>(samples.size()) * clock.T(); }
};

using SweepForcePointer = std::shared_ptr<const SweepForce>;

/// The most recent results of a function of an item's varied values: items with neighbouring indexes often have the same. Thread-safe.
template <class T>
class ValueCache {
    const std::size_t max_size_;
    std::mutex mutex_;
    std::map<std::vector<double>, Result<T>> known_;

public:
    explicit ValueCache(std::size_t max_size) : max_size_(max_size) {}
    /// The result for these values; calls `make` if it is not known.
    template <class Make>
    Result<T> get(const std::vector<double>& values, const Make& make) {
        {
            const std::lock_guard lock(mutex_);
            if (const auto at = known_.find(values); at != known_.end()) return at->second;
        }
        auto made = make();
        const std::lock_guard lock(mutex_);
        if (known_.size() >= max_size_) known_.clear();
        known_.emplace(values, made);
        return made;
    }
};

/// Makes the force of each item.
class ForceFactory {
    std::string text_;                          // the stimulus, or the path of the recording, as in the sweep file
    std::vector<ParameterOverride> overrides_;  // fixed settings, then varied ones, whose values make() fills in
    std::size_t fixed_count_ = 0;               // number of fixed settings
    std::vector<std::size_t> axes_;             // for each varied setting: index of its axis in the plan
    bool is_recording_ = false;
    double rate_ = 10e3;                                    // of a stimulus, Hz
    std::uint64_t seed_ = 0;                                // of a random stimulus
    SweepForcePointer nominal_;                             // without varied values; of a recording: its only force
    std::shared_ptr<ValueCache<SweepForcePointer>> cache_;  // by varied values

    /// `varied_values`: for each varied setting, in their order; or none, for the nominal force.
    Result<SweepForcePointer> make(std::span<const double> varied_values) const;

public:
    /// Reads the force of a sweep file. `folder`: that of the sweep file, to which the path of a recording is relative.
    static Result<ForceFactory> of(const SweepText&, const std::string& folder, std::uint64_t seed);

    const std::string& name() const { return text_; }
    /// True if a name such as "press.F_max" means a parameter of this force.
    bool has_parameter(std::string_view name) const;
    /// VariedQuantity::vary() may be called after all calls of set().
    Result<VariedQuantity> find_quantity(const LocatedText& quantity);
    /// Adds a fixed setting.
    Result<void> set(const LocatedSetting&);
    bool varies() const { return !axes_.empty(); }

    /// Makes the nominal force. Call after all calls of set(), and before nominal() and at().
    Result<void> prepare();
    const SweepForcePointer& nominal() const { return nominal_; }
    /// The force for an item's values on all axes. Thread-safe.
    Result<SweepForcePointer> at(std::span<const double> values) const;
    /// Number of samples, rate and a hash of the recording, in one line; "" for a stimulus.
    std::string recording_summary() const;
};

}  // namespace corpuscle::sweeps
