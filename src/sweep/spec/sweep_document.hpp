#pragma once
// A sweep's results as a JSON document: `corpuscle sweep show --json`.

#include <nlohmann/json_fwd.hpp>

#include "sweep/stats/sweep_summary.hpp"

namespace corpuscle {

/// `title`: of the sweep.
nlohmann::ordered_json document_of(const SweepTable&, const SweepSummary&, const std::string& title);

}  // namespace corpuscle
