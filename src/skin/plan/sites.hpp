#pragma once
// The sites of a skin: the points of a plane at which force is felt. Also which channel of a recording or frame is at which site.

#include <span>

#include "core/force_source.hpp"

namespace corpuscle {

inline constexpr std::size_t max_sites = std::size_t{1} << 22;

// A skin as a set of regions, each made of shapes. The regions are filled with sites.

/// One shape of a region; lengths in m. A strip has two straight sides and, at both ends of its centre line, a width; a capsule is a strip
/// with a round end at each end of its centre line.
struct SkinShape {
    enum class Kind { strip, capsule, ellipse, polygon } kind;
    /// The ends of the centre line for a strip and a capsule, the centre of an ellipse, the corners of a polygon.
    std::vector<Position> points;
    double width = 0;      ///< width of an ellipse, or of a strip or capsule at the first point
    double end_width = 0;  ///< height of an ellipse, or width of a strip or capsule at the second point
    double turns = 0;      ///< of an ellipse: angle from the x axis to the axis of `width`, counter-clockwise, in turns

    bool contains(double x, double y) const;
    /// The corners {left, low} and {right, high} of a box that contains the shape.
    std::pair<Position, Position> bounding_box() const;
};

/// A named part of a skin: the union of its shapes.
struct SkinRegion {
    std::string name;
    std::vector<SkinShape> shapes;
};

/// Sites of one skin. x points to the right, y away from the wrist. A hand is a right hand in palm view.
struct Sites {
    std::vector<Position> positions;      ///< m
    std::vector<std::string> names;       ///< one for each site
    std::vector<std::uint32_t> region;    ///< for each site: index of its region in `regions`
    std::vector<std::string> regions;     ///< names of the regions; at least one
    std::vector<SkinRegion> shapes = {};  ///< the regions' shapes, if the skin is made of them
    double area = 0;                      ///< area of skin that one site represents, m2; 0: sites are separate sensors

    std::size_t size() const { return positions.size(); }
    /// Adds a site, and its region if it is new.
    void add(const Position&, std::string name, const std::string& region_name);
};

/// A grid of sites `pitch` (m) apart, named "r1c1", "r1c2" ... in their order. Site "r1c1" is at the lower left; further rows are above it.
Result<Sites> grid_sites(std::size_t rows, std::size_t columns, double pitch);

/// One site for each channel of a recording, at the channel's position in the layout. A channel without a position is an error.
Result<Sites> channel_sites(std::span<const Channel>);

/// The sites of a text table with the columns name, x and y with a unit ("x_mm", "y [m]"), and optionally region. Other columns are
/// ignored. Errors name file, line and column.
Result<Sites> read_site_table(const std::string& path);

// The site of each channel. For the values of a live frame this is given by a layout file like that of a recording.

/// The numbers of the sites with these names, in the order of the names. A name that is not a site, and one that occurs twice, are errors.
Result<std::vector<std::uint32_t>> find_sites(const Sites&, std::span<const std::string> names);

/// The sites of channels whose names may have units ("r1c1_N"). If no channel has the name of a site, nullopt is returned, and the
/// channels are in the order of the sites. Otherwise all channels must have names of sites.
Result<std::optional<std::vector<std::uint32_t>>> find_sites_if_named(const Sites&, std::span<const std::string> names);

/// Reads a layout file: a table with the columns `channel` (or `sensor`), the number of a value in the frame from 1, and `name`, the name
/// of its site. Other columns are ignored. Every channel from 1 to the highest must have exactly one row. The result has the site of each
/// channel. Errors name file, line and column.
Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites&);

/// Divides the plane into square cells of side `pitch` (m), and places a site at the centre of each cell whose centre is in a region. A
/// centre that is in several regions belongs to the first of them. Each site represents pitch squared of skin. A region without a site is
/// an error.
Result<Sites> fill_regions(std::span<const SkinRegion>, double pitch);

}  // namespace corpuscle
