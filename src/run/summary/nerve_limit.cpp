#include "run/summary/nerve_limit.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/text/quantity.hpp"

namespace corpuscle {

std::string excessive_rate_warning(double rate, const AfferentPlan& plan, const std::string& name) {
    const auto refractory = plan.value("t_ref");
    const auto advice = refractory && *refractory < 1 / max_nerve_rate
                            ? fmt::format(", and give the afferent a refractory period: --set {}.t_ref=1ms", name)
                            : std::string();
    return fmt::format("spikes come at up to {}, but a nerve fibre fires at no more than about {}; check the force's unit and size{}",
                       std::isfinite(rate) ? format_quantity(rate, "Hz") : "any rate", format_quantity(max_nerve_rate, "Hz"), advice);
}

}  // namespace corpuscle
