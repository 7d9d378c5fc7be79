#include "core/parameter.hpp"

#include <fmt/format.h>
#include <numeric>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// The number of letters to replace, insert or remove, or of neighbours to swap; `limit` if it is not less. Upper and lower case are equal.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
    if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
    const auto differ = [&](std::size_t i, std::size_t j) { return lower(a[i]) != lower(b[j]); };
    std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        next[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            next[j + 1] = std::min({row[j] + differ(i, j), next[j] + 1, row[j + 1] + 1});
            const bool is_swapped = i > 0 && j > 0 && !differ(i, j - 1) && !differ(i - 1, j);
            if (is_swapped) next[j + 1] = std::min(next[j + 1], before[j - 1] + 1);
        }
        before = std::exchange(row, next);
    }
    return std::min(row.back(), limit);
}

}  // namespace

Result<void> check_range(std::string_view owner, const ParameterInfo& row, double value) {
    if (value >= row.low && value <= row.high) return {};
    return bad_input(fmt::format("{}: {} = {:g}{}{} is outside [{:g}, {:g}]", owner, row.name, value, row.unit.empty() ? "" : " ", row.unit,
                                 row.low, row.high));
}

Result<void> check_order(std::string_view owner, const ParameterOrder& order, double lower, double upper) {
    if (order.or_equal ? lower <= upper : lower < upper) return {};
    return bad_input(fmt::format("{}: {} = {:g} must {} {} = {:g}", owner, order.lower, lower, order.or_equal ? "not be above" : "be below",
                                 order.upper, upper));
}

std::string did_you_mean(std::string_view typed, std::span<const std::string_view> names) {
    if (typed.empty() || typed.size() > 64) return "";
    std::string_view best;
    // A name is similar if at most half of the typed letters are changed, or one letter of a short name.
    std::size_t best_distance = std::max<std::size_t>(1, typed.size() / 2) + 1;
    for (const auto name : names)
        if (const auto n = edit_distance(typed, name, best_distance); n < best_distance) best_distance = n, best = name;
    return best.empty() ? "" : fmt::format("; did you mean '{}'?", best);
}

}  // namespace corpuscle
