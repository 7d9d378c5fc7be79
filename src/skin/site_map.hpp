#pragma once
// Which site each number of a live frame is: a layout file, as recordings have it.

#include <optional>
#include <string>

#include "skin/sites.hpp"

namespace corpuscle {

/// The sites that have these names, in the order of the names. Refuses a name that no site has, and one that stands twice.
Result<std::vector<std::uint32_t>> sites_named(const Sites&, std::span<const std::string> names);

/// The same of channels that may have other names, with or without units ("r1c1_N"): none of them is a site's, and they go by their order;
/// or else all of them must be.
Result<std::optional<std::vector<std::uint32_t>>> sites_if_named(const Sites&, std::span<const std::string> names);

/// Reads a table with the columns `channel` (or `sensor`), which counts the numbers of a frame from 1, and `name`, the site that the number
/// belongs to. Other columns are passed over. Every channel from 1 to the last has one row. Errors name file, line and column.
Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites&);

}  // namespace corpuscle
