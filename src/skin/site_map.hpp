#pragma once
// Maps each number of a live frame to a site, by a layout file like that of recordings.

#include <optional>
#include <string>

#include "skin/sites.hpp"

namespace corpuscle {

/// The sites with these names, in the order of the names. Refuses a name that is not a site, and one that occurs twice.
Result<std::vector<std::uint32_t>> find_sites(const Sites&, std::span<const std::string> names);

/// The same for channels that may have other names, with or without units ("r1c1_N"). If no channel has the name of a site, there is no
/// mapping and their order counts. Otherwise all channels must have names of sites.
Result<std::optional<std::vector<std::uint32_t>>> find_sites_if_named(const Sites&, std::span<const std::string> names);

/// Reads a table with the columns `channel` (or `sensor`), the number of a value in the frame from 1, and `name`, its site. Other columns
/// are ignored. Every channel from 1 to the last must have one row. Errors name file, line and column.
Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites&);

}  // namespace corpuscle
