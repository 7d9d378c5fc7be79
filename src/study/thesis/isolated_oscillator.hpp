#pragma once
// The oscillator of fig. 38 under a constant current, and the thresholds of its trigger.

#include "study/study_netlist.hpp"

namespace corpuscle {

/// I_LEAK 2 pA, I_CHARGE 1 nA and 1.8 pF, as published with fig. 39.
struct IsolatedOscillator {
    static constexpr double I_LEAK = 2e-12, I_CHARGE = 1e-9, C = 1.8e-12;  // A, F
    double current = 20e-12;                                               ///< A, from 10 ms on
    double stop_time = 0.2;                                                ///< s
    bool has_high_threshold_switches = false;                              ///< switches with a higher threshold, which leak almost nothing
    double leak = I_LEAK;                                                  ///< A
};
/// Records v(u) and v(s) over time, the spikes, and v(u) at rest.
Result<NetlistResult> simulate_oscillator(const IsolatedOscillator&);

/// An output over an input that is swept up and down again.
struct Hysteresis {
    StudyCurve rising, falling;
    double V_H, V_L;  ///< V: input at which the output crosses half the supply of 0.7 V, going up and down
};
/// Reads the curves of an output from the first .dc analysis, which must have `updown`.
Hysteresis find_hysteresis(const NetlistResult&, const std::string& output);
/// Simulates the trigger alone (circuits/schmitt.cir).
Result<Hysteresis> simulate_trigger();

}  // namespace corpuscle
