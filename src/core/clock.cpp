#include "core/clock.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {

Result<Clock> make_clock(double rate, double t0, double tolerance) {
    if (!(rate >= 1e-6 && rate <= 1e12)) return bad_input(fmt::format("a rate of {:g} Hz is outside [1e-06, 1e+12]", rate));
    if (const double rounded = std::round(rate); rounded >= 1 && std::abs(rounded - rate) <= tolerance * rate)
        return Clock{static_cast<std::int64_t>(rounded), 1, t0};
    // Continued fraction of the rate: p1/q1 is the current convergent, p0/q0 the one before it.
    double x = rate, p0 = 1, q0 = 0, p1 = std::floor(x), q1 = 1;
    while (std::abs(p1 / q1 - rate) > tolerance * rate) {
        x = 1 / (x - std::floor(x));
        const double p2 = std::floor(x) * p1 + p0, q2 = std::floor(x) * q1 + q0;
        if (p2 > 1e15 || q2 > 1e15) break;  // the next one is not exact in a double: keep the current one
        p0 = p1, q0 = q1, p1 = p2, q1 = q2;
    }
    return Clock{static_cast<std::int64_t>(p1), static_cast<std::int64_t>(q1), t0};
}

}  // namespace corpuscle
