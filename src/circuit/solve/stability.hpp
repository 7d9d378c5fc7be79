#pragma once
// Stability of an operating point.

#include <optional>
#include <vector>

#include "circuit/solve/operating_point.hpp"

namespace corpuscle::circuit {

/// The fastest growing disturbance of an unstable operating point.
struct UnstableMode {
    std::vector<double> direction;  ///< by unknown; the largest voltage is 1
    double rate;                    ///< 1/s; 0: it oscillates while it grows, and the rate is not known
};

/// Examines a circuit at x, where f(x) = 0. Returns nothing if all disturbances decay. Growth with a time constant above about 100 s, or of
/// an oscillation by less than about 1 % per cycle, is not detected.
std::optional<UnstableMode> find_unstable_mode(NewtonSolver&, std::span<const double> x);

}  // namespace corpuscle::circuit
