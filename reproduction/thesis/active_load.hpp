#pragma once
// A transconductor with its output tied to its input, which then acts as a resistor.

#include "reproduction/claims/study_curve.hpp"

namespace corpuscle {

struct ActiveLoad {
    StudyCurve current, resistance;                    ///< current into the input, A, and dV/dI, ohm; both over the input voltage, V
    double zero_current_voltage = 0;                   ///< V: input voltage at which the current is zero
    double max_resistance = 0, max_resistance_at = 0;  ///< largest resistance, ohm, and the voltage at which it occurs, V
    /// V: the range around max_resistance_at in which the resistance is at least (1 - tolerance) of max_resistance
    double linear_from = 0, linear_to = 0;
};

/// Analyses the input current over the input voltage. If the linear range extends beyond the curve, linear_from is the curve's first
/// voltage, and linear_to is NaN.
ActiveLoad analyse_load(StudyCurve current, double tolerance = 0.1);

}  // namespace corpuscle
