#pragma once
// The contents of a population file as text, before interpretation.

#include <string_view>
#include <vector>

#include "signal/said.hpp"

namespace corpuscle::skins {

using Pair = std::vector<Said>;  ///< two elements in a valid file

/// One shape of a region: { strip = [[x, y], [x, y]], width = [a, b] }.
struct SaidShape {
    Said kind;  ///< "strip"; its location is that of the shape
    std::vector<Pair> points;
    std::vector<Said> width;
    MaybeSaid height, angle;
};

/// One [[region]].
struct SaidRegion {
    Said name;
    std::vector<SaidShape> shapes;
};

/// One site of a list.
struct SaidSite {
    Said name, x, y;
    MaybeSaid region;
};

/// [sites].
struct SaidSites {
    Place place;
    MaybeSaid word;  ///< sites = "channels"
    MaybeSaid rows, columns, pitch, area, file;
    std::vector<SaidSite> list;
    bool listed = false;
};

/// One [[class]].
struct SaidClass {
    Place place;
    MaybeSaid name, afferent, per_site, sigma, hot_spots, hot_spot_spread, velocity, velocity_spread;
    MaybeSaid even_density;            ///< one for all regions
    std::vector<SaidSetting> density;  ///< by region
    std::vector<SaidSetting> set, spread, source;
};

struct SkinText {
    std::string file;
    MaybeSaid title, unit, seed, felt_area;
    std::vector<Said> nerve;
    std::optional<SaidSites> sites;
    std::vector<SaidRegion> regions;
    std::vector<SaidClass> classes;
    std::vector<SaidSetting> source;
};

/// Reads TOML. Refuses unknown keys, and values of the wrong type.
Result<SkinText> read_skin_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::skins
