#pragma once
// Limits the order of BDF where higher orders are unstable.

#include "core/number/elementary.hpp"

namespace corpuscle::circuit {

/// BDF of orders 3 and higher is unstable for a weakly damped oscillation of some range of step length times frequency, as in a ladder of
/// coils and capacitors. Error control then keeps the step at the boundary of that range, although nothing in the solution is as fast.
/// Order 2 damps every oscillation. So where the step has not grown for a while, order 2 is tried: if the step becomes much longer, it
/// stays the highest order; else all orders are allowed again for twice as long as before.
class OrderLimit {
    static constexpr int first_window = 100, trial_window = 40, longest_window = 12800;  // steps
    static constexpr double stagnation = 1.25;  // largest ratio of the mean steps of two successive windows that counts as no growth
    static constexpr double benefit = 4;      // ratio by which order 2 must make the step longer

    enum class Phase { free, trial, limited } phase_ = Phase::free;
    int window_ = first_window, count_ = 0;
    double log_sum_ = 0;    // of the steps of this window
    double last_mean_ = 0;  // mean step of the window before; 0: none
    double reference_ = 0;  // mean step before the trial

    void end_window(double mean, int order) {
        const bool is_longer = mean > benefit * reference_;
        switch (phase_) {
            case Phase::free:
                if (order > 2 && last_mean_ > 0 && mean < stagnation * last_mean_ && last_mean_ < stagnation * mean)
                    phase_ = Phase::trial, reference_ = mean;
                last_mean_ = mean;
                break;
            case Phase::trial:
                phase_ = is_longer ? Phase::limited : Phase::free;
                if (!is_longer && window_ < longest_window) window_ *= 2;
                break;
            case Phase::limited:
                if (!is_longer) phase_ = Phase::free, last_mean_ = 0;
                break;
        }
    }

public:
    /// The highest order that may be used.
    int highest(int max_order) const { return phase_ == Phase::free ? max_order : max_order < 2 ? max_order : 2; }
    bool is_limiting() const { return phase_ != Phase::free; }
    /// Call after an accepted step of this length (s) and order.
    void add_step(double length, int order) {
        log_sum_ += num::log(length);
        if (++count_ < (phase_ == Phase::trial ? trial_window : window_)) return;
        const double mean = num::exp(log_sum_ / count_);
        count_ = 0, log_sum_ = 0;
        end_window(mean, order);
    }
};

}  // namespace corpuscle::circuit
