#pragma once
// Maps each value of a live frame to a site, with a layout file like the layout file of a recording.

#include <optional>
#include <string>

#include "skin/sites.hpp"

namespace corpuscle {

/// The sites with these names, in the order of the names. Refuses a name that is not a site, and one that occurs twice.
Result<std::vector<std::uint32_t>> find_sites(const Sites&, std::span<const std::string> names);

/// The same for channels whose names may have units ("r1c1_N") or may not be sites. If no channel has the name of a site, there is no
/// mapping: the channels are then in the order of the sites. Otherwise all channels must have names of sites.
Result<std::optional<std::vector<std::uint32_t>>> find_sites_if_named(const Sites&, std::span<const std::string> names);

/// Reads a table with the columns `channel` (or `sensor`), the number of a value in the frame from 1, and `name`, its site. Other columns
/// are ignored. Every channel from 1 to the last must have one row. Errors name file, line and column.
Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites&);

}  // namespace corpuscle
