#pragma once
// The contents of a population file as text, before interpretation.

#include <string_view>
#include <vector>

#include "signal/located_text.hpp"

namespace corpuscle::skins {

using PositionSpec = std::vector<LocatedText>;  ///< two elements in a valid file

/// One shape of a region: { strip = [[x, y], [x, y]], width = [a, b] }.
struct ShapeSpec {
    LocatedText kind;  ///< "strip", with the location of the shape
    std::vector<PositionSpec> points;
    std::vector<LocatedText> width;
    OptionalLocatedText height, angle;
};

/// One [[region]].
struct RegionSpec {
    LocatedText name;
    std::vector<ShapeSpec> shapes;
};

/// One site of a list.
struct SiteSpec {
    LocatedText name, x, y;
    OptionalLocatedText region;
};

/// [sites].
struct SitesSpec {
    SourceLocation location;
    OptionalLocatedText word;  ///< sites = "channels"
    OptionalLocatedText rows, columns, pitch, area, file;
    std::vector<SiteSpec> list;
    bool has_list = false;
};

/// One [[class]].
struct ClassSpec {
    SourceLocation location;
    OptionalLocatedText name, afferent, per_site, sigma, hot_spots, hot_spot_spread, velocity, velocity_spread;
    OptionalLocatedText uniform_density;  ///< one for all regions
    std::vector<LocatedSetting> density;  ///< by region
    std::vector<LocatedSetting> set, spread, source;
};

struct SkinSpec {
    std::string file;
    OptionalLocatedText title, unit, seed, felt_area;
    std::vector<LocatedText> nerve;
    std::optional<SitesSpec> sites;
    std::vector<RegionSpec> regions;
    std::vector<ClassSpec> classes;
    std::vector<LocatedSetting> source;
};

/// Reads TOML. Refuses unknown keys, and values of the wrong type.
Result<SkinSpec> parse_skin_spec(std::string_view text, const std::string& file);

}  // namespace corpuscle::skins
