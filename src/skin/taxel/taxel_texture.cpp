#include "skin/taxel/taxel_texture.hpp"

#include <fmt/format.h>
#include <limits>

#include "core/number/elementary.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "skin/contact/contact.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view rough_keys[] = {"roughness", "grain"}, grating_keys[] = {"vibration", "period", "ridge"},
                           slide_keys[] = {"speed", "angle", "t_start", "t_move"};

template <std::size_t N>
bool is_one_of(std::string_view name, const std::string_view (&names)[N]) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// The first of the settings that is one of the names; "" if there is none.
template <std::size_t N>
std::string_view first_of(std::span<const Setting> settings, const std::string_view (&names)[N]) {
    for (const auto& s : settings)
        if (is_one_of(s.name, names)) return s.name;
    return "";
}

/// Checks the settings. They must not be empty.
Result<void> check_texture(std::span<const Setting> settings, const ContactParams& p) {
    for (const auto& s : settings)
        if (!is_one_of(s.name, rough_keys) && !is_one_of(s.name, grating_keys) && !is_one_of(s.name, slide_keys))
            return bad_input(fmt::format("contact.{}: taxels have no indenter; a surface that slides over them has {}; {}; {}", s.name,
                                         joined(rough_keys), joined(grating_keys), joined(slide_keys)));
    const auto a = first_of(settings, rough_keys), b = first_of(settings, grating_keys);
    if (!a.empty() && !b.empty())
        return bad_input(fmt::format("contact.{} is of a rough surface and contact.{} of a grating; remove one of them", a, b));
    if (b.empty() && !(p.roughness > 0))
        return bad_input(
            "contact: the texture that slides is missing; add --set contact.roughness=0.03, or --set contact.period=2mm of a "
            "grating");
    if (!(p.speed > 0)) return bad_input("contact: the speed of the texture is missing; add it, such as --set contact.speed=20mm/s");
    if (!b.empty() && p.ridge > p.period)
        return bad_input(fmt::format("contact: ridge = {:g} m must not be wider than period = {:g} m", p.ridge, p.period));
    return {};
}

std::string describe_texture(const Indenter& indenter, const ContactParams& p) {
    const auto surface =
        indenter.name == "grating"
            ? fmt::format("a grating with a ridge every {}, {:g} of the force", format_quantity(p.period, "m"), p.vibration)
            : fmt::format("a rough surface with bumps every {}, {:g} of the force", format_quantity(p.grain, "m"), p.roughness);
    const auto end = p.t_move > 0 ? fmt::format(" to {}", format_quantity(p.t_start + p.t_move, "s")) : "";
    return fmt::format("{}, that slides at {} from {}{}", surface, format_quantity(p.speed, "m/s"), format_quantity(p.t_start, "s"), end);
}

}  // namespace

TaxelTexture::TaxelTexture(const Indenter& indenter, const ContactParams& p, const Sites& sites, const SlidingTexture::Motion& motion,
                           double rate, std::uint64_t seed)
    : texture_(indenter, p, sites, motion, rate, seed), T_(1 / rate), description_(describe_texture(indenter, p)) {}

std::vector<std::string> TaxelTexture::notes() const {
    std::vector<std::string> out = {fmt::format("the vibration around {} is computed, not measured: that of {}",
                                                format_quantity(texture_.frequency(), "Hz"), description_)};
    if (texture_.left_out() > 0)
        out.push_back(
            fmt::format("{:.2g} % of the mean square of this vibration are at or above half the frame rate of {} and were left "
                        "out; for a recording, --resample 2kHz --interpolation smooth gives more samples",
                        100 * texture_.left_out(), format_quantity(1 / T_, "Hz")));
    return out;
}

Result<Applied<std::unique_ptr<TaxelTexture>>> make_taxel_texture(std::span<const ParameterOverride> overrides, const Sites& sites,
                                                                  double rate, std::uint64_t seed) {
    const auto rows = contact_parameters();
    auto applied = TRY(settings_for("contact", rows, overrides));
    Applied<std::unique_ptr<TaxelTexture>> out{nullptr, std::move(applied.unused)};
    if (applied.result.empty()) return out;
    const auto p = with_settings<ContactParams>(contact_fields, applied.result);
    TRY(check_texture(applied.result, p));
    const auto indenter = TRY(find_indenter(first_of(applied.result, grating_keys).empty() ? "flat" : "grating"));
    const double turns = p.angle / 360;
    const SlidingTexture::Motion motion{{p.speed * num::cos_turns(turns), p.speed * num::sin_turns(turns), 0},
                                        {},
                                        p.t_start,
                                        p.t_move > 0 ? p.t_start + p.t_move : std::numeric_limits<double>::infinity()};
    out.result = std::make_unique<TaxelTexture>(*indenter, p, sites, motion, rate, seed);
    return out;
}

}  // namespace corpuscle
