#pragma once
// The residuals as linear functions of the parameters around a point (Gauss-Newton). Coordinates are natural ones here: ln(value) of a
// logarithmic parameter, in which a factor of 2 is ln 2; of any other the fraction of its bounds.

#include <functional>

#include "core/error.hpp"
#include "fit/fit_problem.hpp"
#include "fit/free_parameter.hpp"
#include "fit/symmetric_matrix.hpp"

namespace corpuscle {

/// The residuals as a function of the search coordinates; an error where they are not allowed.
using ResidualFunction = std::function<Result<std::vector<ResidualBlock>>(std::span<const double> point)>;

/// The residuals that are fitted, one after another.
struct FittedResiduals {
    Vector values;
    std::vector<std::size_t> block;  ///< of each residual: the number of its block, counted from 0
    std::size_t blocks = 0;
};
FittedResiduals fitted_residuals(std::span<const ResidualBlock>);

/// The residuals that are fitted at a point, and their slopes.
struct Linearization {
    FittedResiduals residuals;
    std::vector<Vector> slopes;  ///< of the residuals, for each parameter
    Matrix JJ;                   ///< products of the slopes

    std::size_t size() const { return slopes.size(); }  ///< number of parameters
};

/// Computes the slopes as differences over steps whose effect on the residuals, as a sum of squares, is about `effect`: clearly above that
/// of a spike that appears or disappears, but small against the data.
Result<Linearization> linearize(const ResidualFunction&, std::span<const FreeParameter>, std::span<const double> point, double effect);

/// Improves a point by damped Gauss-Newton steps (Levenberg 1944, Q Appl Math 2:164), which follow narrow valleys. Returns a point with
/// the same or a smaller cost. `effect`: see linearize().
Vector gauss_newton(const ResidualFunction&, std::span<const FreeParameter>, Vector point, double effect,
                    const std::function<bool()>& should_continue);

}  // namespace corpuscle
