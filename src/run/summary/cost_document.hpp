#pragma once
// The costs of the afferents of a run (power, area, leakage) as JSON documents.

#include <nlohmann/json_fwd.hpp>

#include "run/run_inputs.hpp"

namespace corpuscle {

/// For each afferent whose cost is known, in a list without copies: the cost of one afferent at rest under `force` (N), and its mean power
/// during the run, over all its copies and channels. An empty array if no afferent has a known cost.
nlohmann::ordered_json cost_documents_of(std::span<const AfferentPlan>, const RunStats&, double force);

}  // namespace corpuscle
