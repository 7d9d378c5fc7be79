#pragma once
// The power, area and leakage of a circuit as printed tables (run --budget).

#include <string>

#include "circuit/cost/cost.hpp"

namespace corpuscle {

std::string budget_tables(const circuit::Cost&);
/// Power and area in one line, for netlists with several steps.
std::string budget_line(const circuit::Cost&);

}  // namespace corpuscle
