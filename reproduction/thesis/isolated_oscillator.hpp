#pragma once
// The oscillator of fig. 38 under a constant current, and the thresholds of its trigger.

#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {

/// I_LEAK, I_CHARGE and the membrane's capacitance C are published with fig. 39.
struct IsolatedOscillator {
    static constexpr double I_LEAK = 2e-12, I_CHARGE = 1e-9, C = 1.8e-12;  // A, A, F
    double current = 20e-12;                                               ///< A, input current from 10 ms on
    double stop_time = 0.2;                                                ///< s
    bool has_high_threshold_switches = false;                              ///< true: M5B and M6B leak almost nothing
    double leak = I_LEAK;                                                  ///< A, leak current of the simulated oscillator
};
/// The result has the membrane voltage v(u) and the trigger's output v(s) over time, the spikes (rises of v(s)), and the operating point.
Result<NetlistResult> simulate_oscillator(const IsolatedOscillator&);

/// An output over an input that is swept up and down again.
struct Hysteresis {
    StudyCurve rising, falling;  ///< the output while the input rises, and while it falls; both with rising x
    double V_H, V_L;             ///< V: input at which the output crosses 0.35 V, while the input rises and while it falls
};
/// Reads the curves of an output from the first .dc analysis, which must have `updown`.
Hysteresis find_hysteresis(const NetlistResult&, const std::string& output);
/// Simulates the trigger alone (circuits/schmitt.cir).
Result<Hysteresis> simulate_trigger();

}  // namespace corpuscle
