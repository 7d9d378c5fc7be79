#pragma once
// The contents of a population file as text, before interpretation.

#include <string_view>
#include <vector>

#include "signal/located_text.hpp"

namespace corpuscle::skins {

using Pair = std::vector<LocatedText>;  ///< two elements in a valid file

/// One shape of a region: { strip = [[x, y], [x, y]], width = [a, b] }.
struct SaidShape {
    LocatedText kind;  ///< "strip"; its location is that of the shape
    std::vector<Pair> points;
    std::vector<LocatedText> width;
    OptionalLocatedText height, angle;
};

/// One [[region]].
struct SaidRegion {
    LocatedText name;
    std::vector<SaidShape> shapes;
};

/// One site of a list.
struct SaidSite {
    LocatedText name, x, y;
    OptionalLocatedText region;
};

/// [sites].
struct SaidSites {
    SourceLocation place;
    OptionalLocatedText word;  ///< sites = "channels"
    OptionalLocatedText rows, columns, pitch, area, file;
    std::vector<SaidSite> list;
    bool listed = false;
};

/// One [[class]].
struct SaidClass {
    SourceLocation place;
    OptionalLocatedText name, afferent, per_site, sigma, hot_spots, hot_spot_spread, velocity, velocity_spread;
    OptionalLocatedText even_density;            ///< one for all regions
    std::vector<LocatedSetting> density;  ///< by region
    std::vector<LocatedSetting> set, spread, source;
};

struct SkinText {
    std::string file;
    OptionalLocatedText title, unit, seed, felt_area;
    std::vector<LocatedText> nerve;
    std::optional<SaidSites> sites;
    std::vector<SaidRegion> regions;
    std::vector<SaidClass> classes;
    std::vector<LocatedSetting> source;
};

/// Reads TOML. Refuses unknown keys, and values of the wrong type.
Result<SkinText> read_skin_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::skins
