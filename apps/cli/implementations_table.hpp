#pragma once

#include <string>

#include "study/version_comparison.hpp"

namespace corpuscle {

/// A table of the differences between the implementations of one receptor. Empty if no receptor has two.
std::string implementations_table(const VersionComparisons&);

}  // namespace corpuscle
