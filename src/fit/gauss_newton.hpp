#pragma once
// The residuals as linear functions of the parameters around a point (Gauss-Newton). Coordinates are natural ones here: ln(value) of a
// logarithmic parameter, in which a factor of 2 is ln 2; of any other the fraction of its bounds.

#include <functional>
#include <numeric>

#include "core/error.hpp"
#include "fit/fit_problem.hpp"
#include "fit/free_parameter.hpp"

namespace corpuscle {

inline double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Eigenvalues of a symmetric matrix (row after row), in ascending order, and their unit vectors (Jacobi's method).
struct Eigensystem {
    std::vector<double> values;
    std::vector<std::vector<double>> vectors;  ///< one for each value
};
Eigensystem symmetric_eigensystem(std::vector<double> matrix, std::size_t n);

/// The residuals as a function of the search coordinates; an error where they are not allowed.
using ResidualFunction = std::function<Result<std::vector<ResidualBlock>>(std::span<const double> point)>;

/// The residuals that are fitted at a point, and their slopes.
struct Linearization {
    std::vector<double> residuals;
    std::vector<std::size_t> block;  ///< of each residual: the number of its block, counted from 0
    std::size_t blocks = 0;
    std::vector<std::vector<double>> slopes;  ///< of the residuals, for each parameter
    std::vector<double> JJ;                   ///< products of the slopes, row after row

    std::size_t size() const { return slopes.size(); }  ///< number of parameters
};

/// The residuals that are fitted, one after another.
std::vector<double> fitted_values(std::span<const ResidualBlock>);

/// Computes the slopes as differences over steps whose effect on the residuals, as a sum of squares, is about `effect`: clearly above that
/// of a spike that appears or disappears, but small against the data.
Result<Linearization> linearize(const ResidualFunction&, std::span<const FreeParameter>, std::span<const double> point, double effect);

/// Improves a point by damped Gauss-Newton steps (Levenberg 1944, Q Appl Math 2:164), which follow narrow valleys. Returns a point with
/// the same or a smaller cost. `effect`: see linearize().
std::vector<double> gauss_newton(const ResidualFunction&, std::span<const FreeParameter>, std::vector<double> point, double effect,
                                 const std::function<bool()>& should_continue);

}  // namespace corpuscle
