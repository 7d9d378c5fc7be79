#pragma once
// Least squares with exact slopes and bounds (Levenberg 1944, Q Appl Math 2:164; Marquardt 1963, J SIAM 11:431).

#include <functional>

#include "fit/symmetric_matrix.hpp"

namespace corpuscle {

/// The residuals at a point, and their slopes along each coordinate if they were requested.
struct SlopedResiduals {
    Vector values;
    std::vector<Vector> slopes;
};
using SlopedFunction = std::function<SlopedResiduals(const Vector& x, bool with_slopes)>;

struct LeastSquaresFit {
    Vector x;
    SlopedResiduals at;  ///< at x, with slopes
    double cost = 0;     ///< sum of the squared residuals
    bool is_converged = false;
};

/// Minimises the sum of squares from `x`, within the bounds.
LeastSquaresFit least_squares(const SlopedFunction&, Vector x, const Vector& low, const Vector& high);

/// The covariance of the coordinates if the residuals have variance 1. The coordinates in `is_fixed` have none. Directions that the slopes
/// do not determine have a huge variance.
Matrix covariance(const std::vector<Vector>& slopes, const std::vector<bool>& is_fixed);

/// The leverage of each residual, from 0 to 1: a fit with these slopes has reduced its variance by this fraction.
Vector leverages(const std::vector<Vector>& slopes, const std::vector<bool>& is_fixed);

/// The 97.5 % quantile of Student's distribution, to second order in 1 / degrees.
double student_quantile(double degrees);

}  // namespace corpuscle
