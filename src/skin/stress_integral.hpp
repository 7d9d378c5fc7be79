#pragma once
// The equation of DepthKernel, for one number and for SIMD lanes.

#include "core/number/number.hpp"

namespace corpuscle {

/// The arc tangent of y / x for x > 0, computed with + - * / only, so that it has the same bits on every machine. The polynomial
/// interpolates arctan(u) / u at Chebyshev points of u^2 in [0, 1]. Its error is below 1e-14.
template <class T>
T arc_tangent(T y, T x) {
    constexpr double half_pi = 1.5707963267948966;
    constexpr double coefficients[] = {7.16553014867446e-05, -0.0006852193978235228, 0.003092865655338359, -0.00884756737166252,
                                       0.01827367743499713,  -0.029660600244705265,  0.040566795288476246, -0.04980430450976603,
                                       0.057950670797121,    -0.06646369882754061,   0.07688851236155327,  -0.09090494144942093,
                                       0.11111077860612317,  -0.1428571264864567,    0.19999999956842415,  -0.33333333332868115,
                                       0.9999999999999906};
    const T size = num::abs(y), u = num::min(size, x) / num::max(size, x), square = u * u;
    T sum(0.0);
    for (const double c : coefficients) sum = sum * square + T(c);
    const T angle = num::select(size > x, T(half_pi) - u * sum, u * sum);
    return num::select(y < T(0.0), T(-1.0) * angle, angle);
}

/// Newmark's formula (1935), from which tables of the stress below the corner of a foundation are computed. z: depth, m.
template <class T>
T stress_integral(T x, T y, T z) {
    constexpr double two_pi = 6.283185307179586;
    const T x2 = x * x + z * z, y2 = y * y + z * z, r = num::sqrt(x * x + y2), xy = x * y;
    return (arc_tangent(xy, z * r) + xy * z * (x2 + y2) / (r * x2 * y2)) / T(two_pi);
}

}  // namespace corpuscle
