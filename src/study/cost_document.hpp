#pragma once
// The cost of a circuit, as a JSON document.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"
#include "study/afferent_run.hpp"

namespace corpuscle {

nlohmann::ordered_json document_of(const circuit::Cost&);

/// For each netlist afferent: the cost table of one afferent at rest under `force` (N), and the mean power in the run over all copies and
/// channels of the afferent. Empty without netlists.
nlohmann::ordered_json cost_documents_of(std::span<const AfferentPlan>, const RunStats&, double force);

}  // namespace corpuscle
