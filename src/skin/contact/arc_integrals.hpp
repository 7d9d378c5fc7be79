#pragma once
// Integrals over a circular arc, for pressure distributions. They do not use the C library's mathematics, so the results have the same bits
// on every machine.

#include "core/number/number.hpp"

namespace corpuscle {

/// arcsin u for |u| <= 1/2, where z must be u^2; error below 1e-9. It is the Taylor series, evaluated in three independent parts.
inline double small_arcsine(double u, double z) {
    const double z2 = z * z, z4 = z2 * z2;
    const double low = (1 + z * (1.0 / 6)) + z2 * (3.0 / 40 + z * (15.0 / 336));
    const double middle = (105.0 / 3456 + z * (945.0 / 42240)) + z2 * (10395.0 / 599040 + z * (135135.0 / 9676800));
    const double high = (2027025.0 / 175472640 + z * (34459425.0 / 3530096640)) + z2 * (0.00839033 + z * 0.0073125);
    return u * (low + z4 * (middle + z4 * high));
}

/// arcsin u; for u outside [-1, 1] the value at -1 or 1.
inline double arcsine(double u) {
    constexpr double half_pi = 1.5707963267948966;
    const double magnitude = num::abs(u);
    if (magnitude >= 1) return u > 0 ? half_pi : -half_pi;
    if (magnitude <= 0.5) return small_arcsine(u, u * u);
    const double z = 0.5 * (1 - magnitude), angle = half_pi - 2 * small_arcsine(num::sqrt(z), z);
    return u > 0 ? angle : -angle;
}

/// Twice the area below the half circle sqrt(1 - t^2) between t = 0 and t = u, for |u| <= 1; negative for u < 0.
inline double arc_area(double u) {
    const double square = 1 - u * u;
    return arcsine(u) + (square > 0 ? u * num::sqrt(square) : 0);
}

}  // namespace corpuscle
