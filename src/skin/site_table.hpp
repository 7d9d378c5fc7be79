#pragma once
// Sites from a table of text beside a population file.

#include "skin/sites.hpp"

namespace corpuscle {

/// Columns name, x and y ("x_mm", "y [m]"), and perhaps region; others are passed over. Errors name file, line and column.
Result<Sites> read_site_table(const std::string& path);

}  // namespace corpuscle
