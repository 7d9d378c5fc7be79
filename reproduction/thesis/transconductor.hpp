#pragma once
// The current of a transconductor over its differential input voltage, and the figures of merit read from it.

#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {

struct TransconductorCurve {
    StudyCurve current;               ///< A, over the differential input voltage, V
    double zero_current_voltage = 0;  ///< V: input at which the current is zero
    double g_m = 0;                   ///< S, magnitude of the slope at zero_current_voltage
    double max_current = 0;           ///< A, the smaller magnitude of the largest positive and the largest negative current
    /// V: half the width of the range around zero current in which the slope is within 5 % of g_m; limited by the sweep
    double linear_range = 0;
    double power = 0;  ///< W, with equal inputs
    /// 1 if the current rises with the input voltage, otherwise -1
    double sign() const { return current.slope_at(zero_current_voltage) < 0 ? -1 : 1; }
};

/// Sweeps the source `vplus` of a netlist from 0.15 to 0.55 V. In the netlist the other input must be at 0.35 V and the supply 0.7 V. `out`
/// names the output current; i(vi) must be the supply current.
Result<TransconductorCurve> simulate_transconductor(StudyNetlist, const std::string& out = "i(vout)");

/// A differential pair without its load: `columns` by `stack` unit transistors (PMOS) on each side, an ideal tail current `i_b`
/// (A), both drains held at 0.1 V. The output current is the difference of the drain currents.
Result<TransconductorCurve> simulate_isolated_pair(double i_b, int columns, int stack);

}  // namespace corpuscle
