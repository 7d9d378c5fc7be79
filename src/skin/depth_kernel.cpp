#include "skin/depth_kernel.hpp"

#include "skin/stress_integral.hpp"

namespace corpuscle {

double DepthKernel::corner(double x, double y) const { return stress_integral(x, y, depth_); }

double DepthKernel::reach(double fraction) const {
    double low = 0, high = 1e3 * depth_;
    for (int pass = 0; pass < 60; ++pass) {
        const double middle = 0.5 * (low + high);
        (4 * corner(middle, middle) < 1 - fraction ? low : high) = middle;
    }
    return high;
}

}  // namespace corpuscle
