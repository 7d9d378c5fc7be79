#pragma once
// The cost of a circuit (power, area, leakage) as a JSON document.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"
#include "run/run.hpp"

namespace corpuscle {

nlohmann::ordered_json document_of(const circuit::Cost&);

/// For each netlist in a list of afferents without their copies: the cost of one afferent at rest under `force` (N), and its mean power
/// during the run, over all its copies and channels. An empty array if no afferent is a netlist.
nlohmann::ordered_json cost_documents_of(std::span<const AfferentPlan>, const RunStats&, double force);

}  // namespace corpuscle
