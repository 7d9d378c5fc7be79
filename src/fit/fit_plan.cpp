#include "fit/fit_plan.hpp"

#include <fmt/format.h>

#include "run/afferent_plan.hpp"

namespace corpuscle {

Result<PlannedAfferent> plan_to_fit(const std::string& afferent, std::span<const ParameterOverride> overrides) {
    auto planned = TRY(plan_any_afferent(afferent, overrides));
    if (!planned.result.traits().can_search_factor)
        return bad_usage(
            fmt::format("--afferent {}: circuits are too slow to be fitted; fit an afferent of equations, or trim the circuit by "
                        "'corpuscle sweep calibrate {}'",
                        afferent, afferent));
    return planned;
}

}  // namespace corpuscle
