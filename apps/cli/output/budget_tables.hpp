#pragma once
// The power, area and leakage of a circuit as printed tables (run --budget).

#include <string>

#include "circuit/cost/cost.hpp"

namespace corpuscle {

/// Power, area, leakage and, for an afferent, the number of afferents per area and per power.
std::string budget_tables(const circuit::Cost&);
/// Power and area in one line, for a netlist with several variants.
std::string budget_line(const circuit::Cost&);

}  // namespace corpuscle
