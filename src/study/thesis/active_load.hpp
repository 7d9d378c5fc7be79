#pragma once
// A transconductor with its output tied to its input, which then acts as a resistor.

#include "study/study_curve.hpp"

namespace corpuscle {

struct ActiveLoad {
    StudyCurve current, resistance;                    ///< input current, A, and dV/dI, ohm, over the voltage
    double zero_current_voltage = 0;                   ///< V: input voltage at zero current
    double max_resistance = 0, max_resistance_at = 0;  ///< largest resistance, ohm, and its voltage, V
    double linear_from = 0, linear_to = 0;             ///< V: linear range, in which the resistance is close to its largest
};

/// Analyses the input current over the voltage. The linear range ends where the resistance is a fraction `tolerance` below its largest.
ActiveLoad analyse_load(StudyCurve current, double tolerance = 0.1);

}  // namespace corpuscle
