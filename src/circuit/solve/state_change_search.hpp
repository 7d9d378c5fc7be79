#pragma once
// Locates, within a time step, the first change of the state of a device such as a switch.

#include <algorithm>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// A step that ends after a change of state is too long, because it was solved with the equations of the old state. It is solved again with
/// other ends, which the secant method chooses, until the control of the first device that changes is beyond its level by less than its
/// tolerance. The state changes after that step.
class StateChangeSearch {
    const System& system_;
    double low_ = 0, high_ = 0;             // s: no state has changed at low_; some have at high_
    std::vector<double> at_low_, at_high_;  // excess of each device with states there, V or A
    int trials_ = 0;
    std::optional<double> trial_;

    std::vector<double> excesses(std::span<const double> x) const {
        std::vector<double> out;
        for (const auto k : system_.devices_with_states()) out.push_back(system_.excess(k, x));
        return out;
    }
    static bool has_change(const std::vector<double>& excess) {
        return std::ranges::any_of(excess, [](double e) { return e > 0; });
    }
    /// Chooses the end of the next step: the time at which the first state changes, by the secants between low_ and high_. Every third
    /// trial at least halves the interval.
    void choose_trial(std::span<const double> tolerances) {
        double first = ++trials_ % 3 == 0 ? 0.5 : 1;  // as a part of the interval
        for (std::size_t k = 0; k < at_high_.size(); ++k)
            if (const double target = tolerances[k] / 2; at_high_[k] > target)
                first = std::min(first, std::max(target - at_low_[k], 0.0) / (at_high_[k] - at_low_[k]));
        trial_ = low_ + std::clamp(first, 1e-6, 1 - 1e-6) * (high_ - low_);
    }

public:
    explicit StateChangeSearch(const System& system) : system_(system) {}
    bool is_needed() const { return !system_.devices_with_states().empty(); }
    /// Begins a step at t, s.
    void begin(double t, std::span<const double> x) { low_ = t, at_low_ = excesses(x), trials_ = 0, trial_.reset(); }
    /// The end of the step that must be solved next, s; nothing: not known.
    std::optional<double> trial() const { return trial_; }

    /// Examines a step that ends at t, with the solution x there. Returns false if the step can be accepted; otherwise the step to solve
    /// next ends at trial(). `shortest`: an interval (s) that need not be divided. `tolerances`: of each device with states, V or A.
    bool must_try_again(double t, std::span<const double> x, double shortest, std::span<const double> tolerances) {
        auto excess = excesses(x);
        const bool changes = has_change(excess);
        if (!changes && (trials_ == 0 || high_ - t <= shortest)) return false;
        bool is_exact = changes;
        for (std::size_t k = 0; k < excess.size(); ++k) is_exact &= excess[k] <= tolerances[k];
        if (is_exact || (changes && t - low_ <= shortest)) return false;
        if (changes)
            high_ = t, at_high_ = std::move(excess);
        else
            low_ = t, at_low_ = std::move(excess);
        return choose_trial(tolerances), true;
    }
    /// The same for interpolated unknowns x at a time t within a step at whose ends nothing changes. A control that rests at its level, to
    /// within its tolerance, changes nothing.
    bool changes_within(double t, std::span<const double> x, std::span<const double> tolerances) {
        auto excess = excesses(x);
        bool changes = false;
        for (std::size_t k = 0; k < excess.size(); ++k) changes |= excess[k] > tolerances[k];
        if (trials_ > 0 || !changes) return false;
        high_ = t, at_high_ = std::move(excess);
        return choose_trial(tolerances), true;
    }
};

}  // namespace corpuscle::circuit
