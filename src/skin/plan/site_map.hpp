#pragma once
// Finds the site of each channel. For the values of a live frame this is given by a layout file like that of a recording.

#include <optional>
#include <string>

#include "skin/plan/sites.hpp"

namespace corpuscle {

/// The numbers of the sites with these names, in the order of the names. A name that is not a site, and one that occurs twice, are errors.
Result<std::vector<std::uint32_t>> find_sites(const Sites&, std::span<const std::string> names);

/// The sites of channels whose names may have units ("r1c1_N"). If no channel has the name of a site, nullopt is returned, and the
/// channels are in the order of the sites. Otherwise all channels must have names of sites.
Result<std::optional<std::vector<std::uint32_t>>> find_sites_if_named(const Sites&, std::span<const std::string> names);

/// Reads a layout file: a table with the columns `channel` (or `sensor`), the number of a value in the frame from 1, and `name`, the name
/// of its site. Other columns are ignored. Every channel from 1 to the highest must have exactly one row. The result has the site of each
/// channel. Errors name file, line and column.
Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites&);

}  // namespace corpuscle
