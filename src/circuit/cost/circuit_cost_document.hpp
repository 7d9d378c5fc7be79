#pragma once
// The cost of a circuit (power, area, leakage) as a JSON document.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"

namespace corpuscle::circuit {

nlohmann::ordered_json document_of(const Cost&);

}  // namespace corpuscle::circuit
