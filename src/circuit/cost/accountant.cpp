#include "circuit/cost/accountant.hpp"

#include "circuit/force_order.hpp"

namespace corpuscle::circuit {

Result<void> Accountant::watch(RunOrders& orders) {
    const auto rest = bench_.rest();
    if (!rest) return rest.error();
    auto phases = force_phases(*bench_.circuit);
    if (!phases) return phases.error();
    meter_.emplace(bench_.system, rest->x, bench_.tolerances.gmin);
    orders.unknowns = &over_.emplace(*meter_, std::move(*phases));
    return {};
}

}  // namespace corpuscle::circuit
