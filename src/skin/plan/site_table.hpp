#pragma once
// Reads sites from a text table that a population file names.

#include "skin/plan/sites.hpp"

namespace corpuscle {

/// The sites of a table with the columns name, x and y with a unit ("x_mm", "y [m]"), and optionally region. Other columns are ignored.
/// Errors name file, line and column.
Result<Sites> read_site_table(const std::string& path);

}  // namespace corpuscle
