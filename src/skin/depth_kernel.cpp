#include "skin/depth_kernel.hpp"

#include "core/number/number.hpp"

namespace corpuscle {
namespace {

/// The arc tangent, computed with + - * / and sqrt only, so that it has the same bits on every machine. The error is below 1e-15.
double arc_tangent(double x) {
    // Each pass halves the angle. After three passes the tangent is at most 0.2, and the rest of the series is negligible.
    for (int pass = 0; pass < 3; ++pass) x = x / (1 + num::sqrt(1 + x * x));
    const double square = x * x;
    double sum = 0;
    for (int n = 21; n > 0; n -= 2) sum = (n % 4 == 1 ? 1.0 : -1.0) / n + square * sum;
    return 8 * x * sum;
}

}  // namespace

/// Newmark's formula (1935), from which tables of the stress below the corner of a foundation are computed.
double DepthKernel::corner(double x, double y) const {
    const double z = depth_, x2 = x * x + z * z, y2 = y * y + z * z, r = num::sqrt(x * x + y2), xy = x * y;
    constexpr double two_pi = 6.283185307179586;
    return (arc_tangent(xy / (z * r)) + xy * z / r * (1 / x2 + 1 / y2)) / two_pi;
}

double DepthKernel::reach(double fraction) const {
    double low = 0, high = 1e3 * depth_;
    for (int pass = 0; pass < 60; ++pass) {
        const double middle = 0.5 * (low + high);
        (4 * corner(middle, middle) < 1 - fraction ? low : high) = middle;
    }
    return high;
}

}  // namespace corpuscle
