#pragma once
// The contents of a population file as text: values are neither converted nor checked.

#include <string_view>
#include <vector>

#include "core/text/located_text.hpp"

namespace corpuscle::skins {

using PositionSpec = std::vector<LocatedText>;  ///< two elements in a valid file

/// One shape of a region: { strip = [[x, y], [x, y]], width = [a, b] }. See SkinShape for the meaning.
struct ShapeSpec {
    LocatedText kind;  ///< the kind, "strip", and the location of the shape's table
    std::vector<PositionSpec> points;
    std::vector<LocatedText> width;  ///< one width, or two if the file gives a list
    OptionalLocatedText height, angle;
};

/// A [[region]] table.
struct RegionSpec {
    LocatedText name;
    std::vector<ShapeSpec> shapes;
};

/// One site of [sites] list = [...].
struct SiteSpec {
    LocatedText name, x, y;
    OptionalLocatedText region;
};

/// The [sites] table, or the key `sites` with a text.
struct SitesSpec {
    SourceLocation location;
    OptionalLocatedText word;  ///< the text of sites = "channels"
    OptionalLocatedText rows, columns, pitch, area;
    OptionalLocatedText file;  ///< the text of list = "FILE"
    std::vector<SiteSpec> list;
    bool has_list = false;  ///< true if the file has a list of sites, even an empty one
};

/// A [[class]] table.
struct ClassSpec {
    SourceLocation location;
    OptionalLocatedText name, afferent, per_site, sigma, hot_spots, hot_spot_spread, velocity, velocity_spread;
    OptionalLocatedText uniform_density;  ///< density = "...": the same in all regions
    std::vector<LocatedSetting> density;  ///< density = {REGION = "..."}
    std::vector<LocatedSetting> set, spread, source;
};

/// A population file.
struct SkinSpec {
    std::string file;
    OptionalLocatedText title, unit, seed, felt_area;
    std::vector<LocatedText> nerve;
    std::optional<SitesSpec> sites;
    std::vector<RegionSpec> regions;
    std::vector<ClassSpec> classes;
    std::vector<LocatedSetting> source;
};

/// Reads a population file from its text. `file` is its name for messages. Unknown keys and values of the wrong type are errors.
Result<SkinSpec> parse_skin_spec(std::string_view text, const std::string& file);

}  // namespace corpuscle::skins
