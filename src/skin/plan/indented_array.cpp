#include "skin/plan/indented_array.hpp"

#include <fmt/format.h>

#include "skin/contact/skin_cells.hpp"

namespace corpuscle {

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
