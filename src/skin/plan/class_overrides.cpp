#include "skin/plan/class_overrides.hpp"

namespace corpuscle {

Result<Applied<SkinPlan>> apply_overrides(SkinPlan plan, std::span<const ParameterOverride> overrides) {
    std::vector<ParameterOverride> unused(overrides.begin(), overrides.end());
    for (auto& c : plan.classes) {
        const auto settings = TRY(settings_for(c.name, parameter_infos(c.afferent), overrides));
        keep_unused(unused, settings.unused);
        set_values(c.afferent, settings.result);
        TRY(check_plan(c.afferent));
    }
    return Applied<SkinPlan>{std::move(plan), std::move(unused)};
}

std::vector<std::string_view> override_targets(const SkinPlan& plan, std::vector<std::string_view> others) {
    for (const auto& c : plan.classes) others.push_back(c.name);
    return others;
}

}  // namespace corpuscle
