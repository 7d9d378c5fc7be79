#pragma once
// The result of an optimization as tables and as a JSON document.

#include <nlohmann/json_fwd.hpp>

#include "optimize/design_search.hpp"

namespace corpuscle::optimize {

std::string format_result(const OptimizationProblem&, const OptimizationResult&);
nlohmann::ordered_json document_of(const OptimizationProblem&, const OptimizationResult&);
/// The variables with their values before and after, one a line.
std::vector<std::string> design_lines(const OptimizationProblem&, const OptimizationResult&);

/// Why the goal is not better, one clause for each variable that limits it: "i_biasf is at its bound from", "c_u below 5 pF: 4 to 6
/// spikes in protraction fails at corner=ss temp=-20".
std::vector<std::string> limiting_reasons(const OptimizationProblem&, const OptimizationResult&);

}  // namespace corpuscle::optimize
