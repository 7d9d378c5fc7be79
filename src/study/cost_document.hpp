#pragma once
// The cost of a circuit, as a JSON document.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"
#include "study/afferent_run.hpp"

namespace corpuscle {

nlohmann::ordered_json document_of(const circuit::Cost&);

/// Cost of each afferent that is a netlist, for one receptor: its cost table at rest under a force (N), and the mean power over all its
/// copies and channels in the run. Empty without netlists.
nlohmann::ordered_json cost_documents_of(std::span<const AfferentPlan>, const RunStats&, double force);

}  // namespace corpuscle
