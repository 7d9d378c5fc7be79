#pragma once
// The smallest stimulus that evokes a response, by bisection.

#include <functional>

#include "reproduction/claims/trial.hpp"

namespace corpuscle {

enum class SearchScale { linear, logarithmic };

/// Halves the range from `low` to `high` this number of times and returns its upper end. The spikes of the trial that `trial_at` gives for
/// a value decide: if `responds` is true for them, the value is the new upper end, otherwise the new lower end.
Result<double> find_threshold(double low, double high, int halvings, SearchScale, const std::function<TrialSpec(double)>& trial_at,
                              const std::function<bool(const std::vector<double>& spikes)>& responds);

}  // namespace corpuscle
