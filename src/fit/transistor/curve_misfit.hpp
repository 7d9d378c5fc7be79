#pragma once

#include "fit/transistor/transistor_fit.hpp"

namespace corpuscle {

/// How well these currents explain the points.
CurveMisfit curve_misfit(const IvData&, const std::vector<circuit::DrainBulkCurrents>&, const CurveResiduals&);

}  // namespace corpuscle
