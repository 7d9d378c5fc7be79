#pragma once

#include <string>

#include "study/implementation_comparison.hpp"

namespace corpuscle {

/// A table that compares the implementations of each afferent type with the first one. Empty if no type has two implementations.
std::string implementations_table(const ImplementationComparisons&);

}  // namespace corpuscle
