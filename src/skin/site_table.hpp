#pragma once
// Reads sites from a text table beside a population file.

#include "skin/sites.hpp"

namespace corpuscle {

/// Columns name, x and y ("x_mm", "y [m]"), and optionally region; others are ignored. Errors name file, line and column.
Result<Sites> read_site_table(const std::string& path);

}  // namespace corpuscle
