#include "skin/plan/class_overrides.hpp"
#include "skin/contact/skin_cells.hpp"

#include <fmt/format.h>

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

std::string treat_as_skin(SkinPlan& plan) {
    if (plan.sites.area > 0 || plan.felt_area > 0 || plan.sites.size() < 2) return "";
    const SkinCells cells(plan.sites);
    if (!cells.is_lattice()) return "";
    plan.sites.area = cells.side() * cells.side(), plan.felt_area = default_felt_area;
    return fmt::format(
        "{} is pressed with an indenter, so each site represents {:.3g} mm2 of skin and an afferent responds to the force on {:.3g} cm2 "
        "of it, as in hand and fingertip; felt_area in a population file changes this (doc/skin.md)",
        plan.name, 1e6 * plan.sites.area, 1e4 * plan.felt_area);
}

}  // namespace corpuscle
