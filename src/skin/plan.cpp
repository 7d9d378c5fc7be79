#include "skin/plan.hpp"

#include <fmt/format.h>

#include "skin/grid.hpp"

namespace corpuscle {

Result<SkinPlan> plan_skin(std::string_view name, std::span<const Channel>) {
    if (is_grid(name)) return plan_grid(name);
    return bad_usage(fmt::format("there is no population '{}'", name));
}

}  // namespace corpuscle
