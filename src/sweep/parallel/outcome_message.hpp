#pragma once
// Outcomes of work items as a message to another process.

#include "sweep/spec/sweep.hpp"

namespace corpuscle {

std::string pack_outcomes(const std::vector<ItemOutcome>&);
/// Appends the outcomes of a message. Returns false if it is incomplete.
bool unpack_outcomes(std::string message, std::vector<ItemOutcome>&);

}  // namespace corpuscle
