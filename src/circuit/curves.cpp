#include "circuit/curves.hpp"

#include <cmath>

namespace corpuscle::circuit {
namespace {

/// What the letters between v or i and the parenthesis make of a value.
std::optional<std::complex<double>> seen_as(std::string_view view, std::complex<double> x) {
    if (view.empty()) return x;
    if (view == "m") return std::abs(x);
    if (view == "db") return 20 * std::log10(std::abs(x));
    if (view == "p") return std::arg(x);
    if (view == "r") return x.real();
    if (view == "i") return x.imag();
    return {};
}

const std::vector<std::complex<double>>* plain(const Plot& plot, char kind, std::string_view of) {
    const auto* curve = plot.curve(std::string(1, kind) + "(" + std::string(of) + ")");
    return curve == nullptr ? nullptr : &curve->values;
}

}  // namespace

std::optional<std::vector<std::complex<double>>> values_of(const Plot& plot, std::string_view name) {
    if (const auto* curve = plot.curve(name)) return curve->values;
    const auto open = name.find('(');
    if (open == std::string_view::npos || !name.ends_with(')') || (name[0] != 'v' && name[0] != 'i')) return {};
    const auto view = name.substr(1, open - 1), inside = name.substr(open + 1, name.size() - open - 2);
    const auto comma = inside.find(',');
    const auto* plus = plain(plot, name[0], inside.substr(0, comma));
    const auto ground = [](std::string_view n) { return n == "0" || n == "gnd"; };
    if (plus == nullptr && !ground(inside.substr(0, comma))) return {};
    std::vector<std::complex<double>> out = plus != nullptr ? *plus : std::vector<std::complex<double>>(plot.points());
    if (comma != std::string_view::npos && !ground(inside.substr(comma + 1))) {
        const auto* minus = plain(plot, name[0], inside.substr(comma + 1));
        if (minus == nullptr) return {};
        for (std::size_t k = 0; k < out.size(); ++k) out[k] -= (*minus)[k];
    }
    for (auto& x : out) {
        const auto seen = seen_as(view, x);
        if (!seen) return {};
        x = *seen;
    }
    return out;
}

}  // namespace corpuscle::circuit
