#include "skin/depth_kernel.hpp"

#include "core/number/number.hpp"

namespace corpuscle {
namespace {

constexpr double half_pi = 1.5707963267948966;

/// The arc tangent of y / x for x > 0, computed with + - * / only, so that it has the same bits on every machine. The polynomial
/// interpolates arctan(u) / u at Chebyshev points of u^2 in [0, 1]. Its error is below 1e-14.
double arc_tangent(double y, double x) {
    constexpr double coefficients[] = {7.16553014867446e-05, -0.0006852193978235228, 0.003092865655338359, -0.00884756737166252,
                                       0.01827367743499713,  -0.029660600244705265,  0.040566795288476246, -0.04980430450976603,
                                       0.057950670797121,    -0.06646369882754061,   0.07688851236155327,  -0.09090494144942093,
                                       0.11111077860612317,  -0.1428571264864567,    0.19999999956842415,  -0.33333333332868115,
                                       0.9999999999999906};
    const double size = num::abs(y), u = num::min(size, x) / num::max(size, x), square = u * u;
    double sum = 0;
    for (const double c : coefficients) sum = sum * square + c;
    const double angle = size > x ? half_pi - u * sum : u * sum;
    return y < 0 ? -angle : angle;
}

}  // namespace

/// Newmark's formula (1935), from which tables of the stress below the corner of a foundation are computed.
double DepthKernel::corner(double x, double y) const {
    const double z = depth_, x2 = x * x + z * z, y2 = y * y + z * z, r = num::sqrt(x * x + y2), xy = x * y;
    return (arc_tangent(xy, z * r) + xy * z * (x2 + y2) / (r * x2 * y2)) / (4 * half_pi);
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
