#pragma once
// First values of V_T0, I_SQ and n by the procedure of g_m/I_D, in closed form from one sweep of V_G.

#include "fit/transistor/curve_residuals.hpp"

namespace corpuscle {

/// The base card with these values. Without a suitable sweep, the best of a coarse grid of thresholds.
circuit::UicmCard start_values(const IvData&, const CurveResiduals&, const circuit::UicmCard& base);

}  // namespace corpuscle
