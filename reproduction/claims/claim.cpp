#include "reproduction/claims/claim.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

/// Units that are not written with an SI prefix.
constexpr std::array<std::string_view, 9> units_without_prefix = {"%", "C", "gf", "dB", "degrees", "spikes", "times", "um^2", "mm^2"};

/// True for a value that is only rounding error and may differ between machines: far smaller than the limits of the allowed range, or below
/// 1e-9 percent.
bool is_rounding(double x, const Claim& c) {
    double largest_limit = 0;
    for (const double limit : {c.allowed_min, c.allowed_max})
        if (std::isfinite(limit)) largest_limit = std::max(largest_limit, std::abs(limit));
    return std::abs(x) < 1e-5 * largest_limit || (c.unit == "%" && std::abs(x) < 1e-9);
}

}  // namespace

std::string format_claim_value(double x, const Claim& c) {
    if (std::isnan(x)) return "-";
    if (is_rounding(x, c)) x = 0;
    if (c.is_boolean) return x > 0 ? "yes" : "no";
    if (c.unit.empty()) return fmt::format("{:.4g}", x);
    if (std::find(units_without_prefix.begin(), units_without_prefix.end(), c.unit) != units_without_prefix.end())
        return fmt::format("{:.4g} {}", x, c.unit);
    return format_quantity(x, c.unit);
}

std::string format_published(const Claim& c) {
    const auto text = format_claim_value(c.published, c);
    return c.is_derived ? fmt::format("({})", text) : text;
}

std::string format_allowed_range(const Claim& c) {
    if (!c.has_allowed_range()) return std::isnan(c.tolerance) ? "-" : "within " + format_claim_value(c.tolerance, c);
    if (c.is_boolean) return format_claim_value(c.allowed_min, c);
    if (std::isnan(c.allowed_min)) return "at most " + format_claim_value(c.allowed_max, c);
    if (std::isnan(c.allowed_max)) return "at least " + format_claim_value(c.allowed_min, c);
    return c.allowed_min == c.allowed_max
               ? format_claim_value(c.allowed_min, c)
               : fmt::format("{} to {}", format_claim_value(c.allowed_min, c), format_claim_value(c.allowed_max, c));
}

std::string format_deviation(const Claim& c) {
    const double percent = 100 * c.deviation();
    if (std::isnan(percent)) return "-";
    return std::abs(percent) < 0.05 ? "0.0 %" : fmt::format("{:+.1f} %", percent);
}

}  // namespace corpuscle
