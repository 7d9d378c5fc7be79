#include "study/afferents.hpp"

#include <fmt/format.h>

#include "circuit/afferent.hpp"

namespace corpuscle {

Result<AfferentPlan> plan_any_afferent(std::string_view text, std::span<const Wish> wishes) {
    if (!names_netlist(text)) return plan_afferent(text, wishes);
    const std::string path(text);
    auto design = circuit::CircuitDesign::read(path);
    if (!design) return design.error();
    for (const auto& wish : wishes)
        if (wish.of == text) return bad_usage(fmt::format("--set {}: a netlist's values stand in the netlist", wish.text()));
    AfferentPlan plan;
    plan.name = path;
    plan.parameters = std::make_shared<const std::vector<Parameter>>();
    plan.sentence = (*design)->title();
    plan.design = std::move(*design);
    return plan;
}

}  // namespace corpuscle
