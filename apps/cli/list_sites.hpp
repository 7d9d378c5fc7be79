#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The sites of one population, in the order of the forces in a frame, as CSV or JSON. Returns an error unless `populations` has one entry.
/// The CSV can be used as the site list of a population file.
Result<std::string> sites_listing(const std::vector<std::string>& populations, bool json);

}  // namespace corpuscle
