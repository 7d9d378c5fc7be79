#include "circuit/cost/cost_meter.hpp"

#include "circuit/afferent/force_directive.hpp"

namespace corpuscle::circuit {

Result<void> CostMeter::attach(RunOptions& options) {
    const auto operating_point = context_.operating_point();
    if (!operating_point) return operating_point.error();
    auto phases = force_phases(*context_.circuit);
    if (!phases) return phases.error();
    meter_.emplace(context_.system, operating_point->x, context_.tolerances.gmin);
    options.unknowns_sink = &power_over_time_.emplace(*meter_, std::move(*phases));
    return {};
}

}  // namespace corpuscle::circuit
