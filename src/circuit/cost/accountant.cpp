#include "circuit/cost/accountant.hpp"

#include "circuit/force_order.hpp"

namespace corpuscle::circuit {

Result<void> Accountant::watch(RunOrders& options) {
    const auto rest = context_.rest();
    if (!rest) return rest.error();
    auto phases = force_phases(*context_.circuit);
    if (!phases) return phases.error();
    meter_.emplace(context_.system, rest->x, context_.tolerances.gmin);
    options.unknowns = &over_.emplace(*meter_, std::move(*phases));
    return {};
}

}  // namespace corpuscle::circuit
