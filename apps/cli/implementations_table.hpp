#pragma once

#include <string>

#include "study/version_comparison.hpp"

namespace corpuscle {

/// A table that compares the implementations of each receptor with its first one. Empty if no receptor has two implementations.
std::string implementations_table(const VersionComparisons&);

}  // namespace corpuscle
