#include "study/claim.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

/// Units without SI prefixes.
constexpr std::array<std::string_view, 8> units_without_prefix = {"%", "C", "gf", "dB", "degrees", "spikes", "times", "um^2"};

/// True for a value that is only rounding error and differs between machines: far below the allowed range, or below 1e-9 percent.
bool is_rounding(double x, const Claim& c) {
    double allowed = 0;
    for (const double end : {c.low, c.high})
        if (std::isfinite(end)) allowed = std::max(allowed, std::abs(end));
    return std::abs(x) < 1e-5 * allowed || (c.unit == "%" && std::abs(x) < 1e-9);
}

}  // namespace

std::string quantity_of(double x, const Claim& c) {
    if (std::isnan(x)) return "-";
    if (is_rounding(x, c)) x = 0;
    if (c.is_truth) return x > 0 ? "yes" : "no";
    if (c.unit.empty()) return fmt::format("{:.4g}", x);
    if (std::find(units_without_prefix.begin(), units_without_prefix.end(), c.unit) != units_without_prefix.end())
        return fmt::format("{:.4g} {}", x, c.unit);
    return format_quantity(x, c.unit);
}

std::string printed_of(const Claim& c) {
    const auto text = quantity_of(c.printed, c);
    return c.follows ? fmt::format("({})", text) : text;
}

std::string allowed_of(const Claim& c) {
    if (!c.judged()) return "-";
    if (c.is_truth) return quantity_of(c.low, c);
    if (std::isnan(c.low)) return "at most " + quantity_of(c.high, c);
    if (std::isnan(c.high)) return "at least " + quantity_of(c.low, c);
    return c.low == c.high ? quantity_of(c.low, c) : fmt::format("{} to {}", quantity_of(c.low, c), quantity_of(c.high, c));
}

std::string deviation_of(const Claim& c) {
    const double percent = 100 * c.deviation();
    if (std::isnan(percent)) return "-";
    return std::abs(percent) < 0.05 ? "0.0 %" : fmt::format("{:+.1f} %", percent);
}

}  // namespace corpuscle
