#include "skin/contact/indenters.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"
#include "skin/contact/contact.hpp"
#include "skin/contact/contact_shear.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view path_parameters[] = {"x", "y", "x1", "y1", "t_start", "t_move", "speed", "tilt", "azimuth", "friction"};

bool has_parameter(const Indenter& i, std::string_view name) {
    return std::find(i.parameters.begin(), i.parameters.end(), name) != i.parameters.end() || is_path_parameter(name);
}

/// The centre of the first region: the mean position of its sites, rounded to 1 um.
Position centre_of_first_region(const Sites& sites) {
    Position sum;
    double n = 0;
    for (std::size_t s = 0; s < sites.size(); ++s)
        if (sites.region[s] == 0) sum.x += sites.positions[s].x, sum.y += sites.positions[s].y, n += 1;
    const auto rounded = [](double m) { return std::round(m * 1e6) / 1e6 + 0.0; };  // + 0.0 turns -0 into 0
    return n > 0 ? Position{rounded(sum.x / n), rounded(sum.y / n), 0} : sites.positions[0];
}

/// Checks the parameters that depend on one another.
Result<void> check_contact(const Indenter& i, const ContactParams& p) {
    if (i.name == "grating" && p.ridge > p.period)
        return bad_input(fmt::format("contact: ridge = {:g} m must not be wider than period = {:g} m", p.ridge, p.period));
    if (p.t_move > 0 && p.speed > 0) return bad_input("contact: t_move and speed are alternatives; give only one of them");
    if (is_moving(p) && p.t_move == 0 && p.speed == 0)
        return bad_input("contact: the speed of the movement to x1, y1 is missing; give contact.t_move or contact.speed");
    if (!is_moving(p) && (p.t_move > 0 || (p.speed > 0 && i.name != "grating" && p.roughness == 0)))
        return bad_input("contact: the end of the movement is missing; give contact.x1 or contact.y1");
    return {};
}

}  // namespace

bool is_path_parameter(std::string_view name) {
    return std::find(std::begin(path_parameters), std::end(path_parameters), name) != std::end(path_parameters);
}

std::vector<ParameterInfo> contact_parameters() { return parameters_of<ContactParams>(contact_fields); }

Result<const Indenter*> find_indenter(std::string_view name) {
    std::vector<std::string_view> names;
    for (const auto& i : indenters) {
        if (i.name == name) return &i;
        names.push_back(i.name);
    }
    return bad_usage(fmt::format("there is no indenter '{}'{} (there are {})", name, did_you_mean(name, names), joined(names)));
}

Result<Applied<ContactParams>> read_contact_params(const Indenter& indenter, std::span<const ParameterOverride> overrides,
                                                   const Sites& sites) {
    const auto rows = contact_parameters();
    auto applied = TRY(settings_for("contact", rows, overrides));
    const auto& settings = applied.result;
    const auto is_set = [&](std::string_view name) {
        return std::any_of(settings.begin(), settings.end(), [&](const Setting& s) { return s.name == name; });
    };
    for (const auto& s : settings)
        if (!has_parameter(indenter, s.name))
            return bad_input(fmt::format(
                "contact.{}: {} has no such parameter (it has {}, and for its path and shear {})", s.name, indenter.name,
                joined(std::span(indenter.parameters.begin(), std::find(indenter.parameters.begin(), indenter.parameters.end(), ""))),
                joined(path_parameters)));
    auto p = with_settings<ContactParams>(contact_fields, settings);
    if (!is_set("x") && !is_set("y")) {
        const auto middle = centre_of_first_region(sites);
        p.x = middle.x, p.y = middle.y;
    }
    if (!is_set("x1")) p.x1 = p.x;
    if (!is_set("y1")) p.y1 = p.y;
    TRY(check_contact(indenter, p));
    TRY(check_contact_shear(indenter, p, is_set("E_star")));
    return Applied<ContactParams>{p, std::move(applied.unused)};
}

}  // namespace corpuscle
