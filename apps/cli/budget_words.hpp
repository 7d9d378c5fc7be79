#pragma once
// What a circuit costs, in tables for people.

#include <string>

#include "circuit/cost/cost.hpp"

namespace corpuscle {

std::string budget_text(const circuit::Cost&);
/// Of one of many: power and area alone.
std::string budget_line(const circuit::Cost&);

}  // namespace corpuscle
