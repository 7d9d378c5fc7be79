#pragma once
// The force on a sweep's afferents: a stimulus, whose parameters may vary between items, or a channel of a recording.

#include <map>
#include <memory>
#include <mutex>

#include "signal/force_source.hpp"
#include "signal/parameter_override.hpp"
#include "study/sweep/axis.hpp"

namespace corpuscle::sweeps {

/// One complete force signal.
struct SweepForce {
    std::vector<double> samples;  ///< N
    Clock clock;                  ///< with the first sample at 0 s
    std::vector<Phase> phases;
    double cycle_frequency = 0;  ///< Hz; 0 if the stimulus has no cycle

    double end() const { return static_cast<double>(samples.size()) * clock.T(); }
};

class ForceFactory {
    std::string text_;
    std::vector<ParameterOverride> overrides_;  // fixed settings, then varied ones, whose value is filled in
    std::size_t fixed_count_ = 0;
    std::vector<std::size_t> axes_;  // of each varied setting: index of its axis
    double rate_ = 10e3;
    std::uint64_t seed_ = 0;
    std::shared_ptr<const SweepForce> nominal_;
    struct Cache;
    std::shared_ptr<Cache> cache_;

    /// `varied_values`: of the varied settings, in their order; those without a value keep their default.
    Result<std::shared_ptr<const SweepForce>> make(std::span<const double> varied_values) const;

public:
    /// A recording's path is relative to the folder of the sweep file.
    static Result<ForceFactory> of(const SweepText&, const std::string& folder, std::uint64_t seed);

    const std::string& name() const { return text_; }
    /// True if "press.F_max" is a parameter of this force.
    bool has_parameter(std::string_view name) const;
    Result<VariedQuantity> find_quantity(const LocatedText& quantity) const;
    Result<void> set(const LocatedSetting&);
    /// Call after all calls of set().
    void vary(const std::string& name, std::size_t axis);
    bool varies() const { return !axes_.empty(); }

    /// Call after all settings: makes the nominal force.
    Result<void> prepare();
    const std::shared_ptr<const SweepForce>& nominal() const { return nominal_; }
    /// The force for an item's values on all axes. Thread-safe.
    Result<std::shared_ptr<const SweepForce>> at(std::span<const double> values) const;
    /// A description of the recording, in a line; "" for a stimulus.
    std::string recording_summary() const;

private:
    bool is_recording_ = false;
};

}  // namespace corpuscle::sweeps
