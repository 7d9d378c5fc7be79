#pragma once
// What a circuit costs, as a document.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"
#include "study/respond.hpp"

namespace corpuscle {

nlohmann::ordered_json document_of(const circuit::Cost&);

/// What each afferent costs that is a netlist, one receptor of it: its sheet at rest under a force (N), and the mean power over all that
/// was answered, of its copies and channels. Empty without netlists.
nlohmann::ordered_json costs_of(std::span<const AfferentPlan>, const Work&, double force);

}  // namespace corpuscle
