#pragma once
// How well the data determine the parameters, from the linearized residuals around the best point.

#include "fit/gauss_newton.hpp"

namespace corpuscle {

/// The interval of one parameter.
struct ParameterCertainty {
    bool is_identified = false;
    double half_width = 0;  ///< of the 95 % interval, in the natural coordinate
};

/// A direction along which the parameters can change together without much effect on the cost.
struct WeakDirection {
    std::vector<double> direction;  ///< unit vector in natural coordinates
};

struct Identifiability {
    std::vector<ParameterCertainty> parameters;
    std::vector<WeakDirection> weak;  ///< the weakest first
};

/// Differences of the cost that are smaller are taken as 0: a tenth of a spike, or of the square of a target's deviation.
inline constexpr double negligible_cost = 0.1;

/// The residuals of an imagined repetition with this noise and seed, see FitProblem::repetition().
using RepetitionFunction = std::function<Result<std::vector<ResidualBlock>>(double noise, std::uint64_t seed)>;

/// Finds which parameters the residuals determine at a point, and how well. Held-out blocks do not count. If the deviations of the
/// residuals are not known, two estimates of each interval are made, and the wider one is used. One comes from repetitions with the noise
/// that explains the residuals (if there is a function), the other from leaving out blocks.
Result<Identifiability> identifiability(const ResidualFunction&, std::span<const FreeParameter>, std::span<const double> point,
                                        double slope_effect, bool has_known_deviations, const RepetitionFunction& = {});

}  // namespace corpuscle
