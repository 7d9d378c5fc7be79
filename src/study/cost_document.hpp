#pragma once
// What a circuit costs, as a document.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"

namespace corpuscle {

nlohmann::ordered_json document_of(const circuit::Cost&);

}  // namespace corpuscle
