#pragma once

#include <string>

#include "study/comparisons.hpp"

namespace corpuscle {

/// How the versions of one receptor differ, a line each; empty if nobody has two.
std::string versions_table(const Comparisons&);

}  // namespace corpuscle
