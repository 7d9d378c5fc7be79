#pragma once
// Where something that is known at any time between two begins to be above nothing.

#include <algorithm>
#include <cmath>
#include <optional>

namespace corpuscle::circuit {

/// Nothing: it is not below at `from` and above at `to`.
template <class Above>
std::optional<double> crossing_between(double from, double to, const Above& above) {
    if (!(above(from) <= 0 && above(to) > 0)) return {};
    for (int k = 0; k < 50; ++k) {
        const double half = from + (to - from) / 2;
        above(half) > 0 ? to = half : from = half;
    }
    return to;
}

/// The same where its values at both ends are known. It may also come to be above and go again, or the other way round, where an end is
/// nearer to nothing than the ends are to each other: then it is looked at between them, too.
template <class Above>
std::optional<double> crossing_within(double from, double to, double at_from, double at_to, const Above& above) {
    if (at_from <= 0 && at_to > 0) return crossing_between(from, to, above);
    if (std::min(std::abs(at_from), std::abs(at_to)) > std::abs(at_to - at_from)) return {};
    constexpr int parts = 4;
    for (int k = 0; k < parts; ++k) {
        const double a = from + (to - from) * k / parts, b = k + 1 < parts ? from + (to - from) * (k + 1) / parts : to;
        if (const auto found = crossing_between(a, b, above)) return found;
    }
    return {};
}

}  // namespace corpuscle::circuit
