#include "fit/transistor/card_parameter.hpp"

#include <cmath>
#include <limits>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

using circuit::UicmCard;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN(), infinite = 1e30;
using enum SearchScale;

constexpr CardParameter all_parameters[] = {
    {"V_T0", "vto", "V", &UicmCard::V_T0, linear, -5, 5, 1e-4, 0.05, unknown},
    {"I_SQ", "isq", "A", &UicmCard::I_SQ, logarithmic, -34, 0, 1e-4, 0.5, unknown},
    {"n", "n", "", &UicmCard::n, linear, 1.001, 4.9, 1e-4, 0.15, unknown},
    {"gamma", "gamma", "V^0.5", &UicmCard::gamma, linear, 1e-3, 9, 1e-4, 0.2, 0, true},
    {"sigma L", "sigmal", "m", &UicmCard::sigma_L, linear, 0, 1e-3, 1e-10, 0.03, 0, false, true},
    {"zeta L", "zetal", "m", &UicmCard::zeta_L, linear, 0, 1e-3, 1e-10, 0.1, 0, false, true},
    {"V_E", "ve", "V/m", &UicmCard::V_E, inverse, 0, 1e-4, 1e-10, 0.5, infinite, false, true},
    {"J_S", "js", "A/m^2", &UicmCard::J_S, logarithmic, -60, 0, 1e-4, 1.5, 0},
    {"J_SSW", "jssw", "A/m", &UicmCard::J_SSW, logarithmic, -70, 0, 1e-4, 1.5, 0, true},
    {"n_dio", "nj", "", &UicmCard::n_dio, linear, 0.51, 9.9, 1e-4, 0.3, 1},
    {"alpha_VT", "tcv", "V/K", &UicmCard::alpha_VT, linear, -0.1, 0.1, 1e-6, 1e-3, -0.4e-3},
    {"I_S exponent", "tis", "", &UicmCard::I_S_exponent, linear, -5, 5, 1e-3, 1, 0.5},
};

constexpr MismatchParameter all_mismatch[] = {{"A_VT", "avt", "V m", &UicmCard::A_VT}, {"A_K", "ais", "m", &UicmCard::A_IS}};

}  // namespace

std::span<const MismatchParameter> mismatch_parameters() { return all_mismatch; }
std::span<const CardParameter> card_parameters() { return all_parameters; }

const CardParameter* find_card_parameter(std::string_view name) {
    for (const auto& p : all_parameters)
        if (equal_ignoring_case(name, p.name) || equal_ignoring_case(name, p.card_name)) return &p;
    // The symbols without their length, as in the equations.
    if (equal_ignoring_case(name, "sigma")) return find_card_parameter("sigmal");
    if (equal_ignoring_case(name, "zeta")) return find_card_parameter("zetal");
    return nullptr;
}

double value_of_coordinate(const CardParameter& p, double x) {
    if (p.scale == logarithmic) return num::exp(x);
    if (p.scale == inverse) return x == 0 ? infinite : 1 / x;
    return x;
}

double coordinate_of_value(const CardParameter& p, double value) {
    const double x = p.scale == logarithmic ? num::log(std::max(value, 1e-300)) : p.scale == inverse ? 1 / value : value;
    return std::clamp(x, p.low, p.high);
}

UicmCard card_at(UicmCard card, std::span<const CardParameter* const> parameters, const Vector& x) {
    for (std::size_t k = 0; k < parameters.size(); ++k) card.*parameters[k]->member = value_of_coordinate(*parameters[k], x[k]);
    return card;
}

Vector coordinates_of(const UicmCard& card, std::span<const CardParameter* const> parameters) {
    Vector out;
    for (const auto* p : parameters) out.push_back(coordinate_of_value(*p, card.*p->member));
    return out;
}

}  // namespace corpuscle
