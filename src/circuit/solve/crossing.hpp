#pragma once
// Where something that is known at any time between two begins to be above nothing.

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

}  // namespace corpuscle::circuit
