#pragma once
// Whether a circuit stays where it rests.

#include <optional>
#include <vector>

#include "circuit/solve/operating_point.hpp"

namespace corpuscle::circuit {

/// How a disturbance of an unstable equilibrium grows.
struct Growth {
    std::vector<double> direction;  ///< of the unknowns; the largest voltage is 1
    double rate;                    ///< 1/s; 0: it swings while it grows, and how fast is not known
};

/// Of the circuit at x, where f(x) = 0. Nothing: disturbances die out; or grow in more than a hundred seconds, or by less than some
/// hundredth while they swing once.
std::optional<Growth> growth_at(Newton&, std::span<const double> x);

}  // namespace corpuscle::circuit
