#include "study/claim.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

/// Those that nobody says kilo of.
constexpr std::array<std::string_view, 8> bare = {"%", "C", "gf", "dB", "degrees", "spikes", "times", "um^2"};

}  // namespace

std::string quantity_of(double x, const Claim& c) {
    if (std::isnan(x)) return "-";
    if (c.is_truth) return x > 0 ? "yes" : "no";
    if (c.unit.empty()) return fmt::format("{:.4g}", x);
    if (std::find(bare.begin(), bare.end(), c.unit) != bare.end()) return fmt::format("{:.4g} {}", x, c.unit);
    return format_quantity(x, c.unit);
}

std::string allowed_of(const Claim& c) {
    if (!c.judged()) return "-";
    if (c.is_truth) return quantity_of(c.low, c);
    if (std::isnan(c.low)) return "at most " + quantity_of(c.high, c);
    if (std::isnan(c.high)) return "at least " + quantity_of(c.low, c);
    return c.low == c.high ? quantity_of(c.low, c) : fmt::format("{} to {}", quantity_of(c.low, c), quantity_of(c.high, c));
}

std::string deviation_of(const Claim& c) { return std::isnan(c.deviation()) ? "-" : fmt::format("{:+.1f} %", 100 * c.deviation()); }

}  // namespace corpuscle
