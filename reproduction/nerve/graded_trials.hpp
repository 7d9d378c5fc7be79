#pragma once
// Simulates many copies of one afferent together, each under the same force times a factor of its own.

#include "reproduction/claims/trial.hpp"

namespace corpuscle {

/// The spike times (s) of each copy of the trial's afferent, which must be a model. Its probes are not recorded. Copy k feels the stimulus
/// times factors[k] and has random numbers of its own.
Result<std::vector<std::vector<double>>> simulate_factors(const TrialSpec&, std::span<const double> factors);

/// Numbers from `low` to `high` or a little above, each `step` times the one before.
std::vector<double> geometric_series(double low, double high, double step);

}  // namespace corpuscle
