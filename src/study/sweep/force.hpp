#pragma once
// The force that a sweep's afferents feel: a stimulus, whose parameters may vary from unit to unit, or a channel of a recording.

#include <map>
#include <memory>
#include <mutex>

#include "signal/settings.hpp"
#include "signal/source.hpp"
#include "study/sweep/axis.hpp"

namespace corpuscle::sweeps {

/// One force, whole.
struct FeltForce {
    std::vector<double> samples;  ///< N
    Clock clock;                  ///< the first sample at 0 s
    std::vector<Phase> phases;
    double cycle = 0;  ///< Hz

    double end() const { return static_cast<double>(samples.size()) * clock.T(); }
};

class ForceMaker {
    std::string text_;
    std::vector<Wish> wishes_;  // what is set, then what varies, whose text is put in
    std::size_t fixed_ = 0;
    std::vector<std::size_t> axes_;  // of each wish that varies: its place among the values of a unit
    double rate_ = 10e3;
    std::uint64_t seed_ = 0;
    std::shared_ptr<const FeltForce> nominal_;
    struct Kept;
    std::shared_ptr<Kept> kept_;

    Result<std::shared_ptr<const FeltForce>> make(std::span<const double> values) const;

public:
    /// A recording is looked for beside the sweep file.
    static Result<ForceMaker> of(const SweepText&, const std::string& folder, std::uint64_t seed);

    const std::string& name() const { return text_; }
    /// Whether "press.F_max" is its own.
    bool owns(std::string_view name) const;
    Result<Target> target(const Said& what) const;
    Result<void> set(const SaidSetting&);
    void vary(const std::string& name, std::size_t axis);
    bool varies() const { return !axes_.empty(); }

    /// After all is set: with nothing varied.
    Result<void> prepare();
    const std::shared_ptr<const FeltForce>& nominal() const { return nominal_; }
    /// For the values of a unit; from several threads at once.
    Result<std::shared_ptr<const FeltForce>> at(std::span<const double> values) const;
    /// What a recording held, in a line; "" of a stimulus.
    std::string recorded() const;

private:
    bool recording_ = false;
};

}  // namespace corpuscle::sweeps
