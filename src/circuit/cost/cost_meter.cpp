#include "circuit/cost/cost_meter.hpp"

#include "circuit/afferent/force_directive.hpp"

namespace corpuscle::circuit {

Result<void> CostMeter::attach(RunOptions& options) {
    const auto operating_point = TRY(context_.operating_point());
    auto phases = TRY(force_phases(*context_.circuit));
    meter_.emplace(context_.system, operating_point.x, context_.tolerances.gmin);
    options.unknowns_sink = &power_over_time_.emplace(*meter_, std::move(phases));
    return {};
}

}  // namespace corpuscle::circuit
