#pragma once
// The table that `corpuscle respond` prints below the rates.

#include <string>

#include "run/compare/implementation_comparison.hpp"

namespace corpuscle {

/// A table that compares the implementations of each afferent type with its reference (ImplementationGroup). "" if no type has several
/// implementations.
std::string implementations_table(const ImplementationComparisons&);

}  // namespace corpuscle
