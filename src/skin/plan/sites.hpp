#pragma once
// The sites of a skin: the points of a plane at which force is felt.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/force_source.hpp"

namespace corpuscle {

inline constexpr std::size_t max_sites = std::size_t{1} << 22;

/// Sites of one skin. x points to the right, y away from the wrist. A hand is a right hand in palm view.
struct Sites {
    std::vector<Position> positions;    ///< m
    std::vector<std::string> names;     ///< one for each site
    std::vector<std::uint32_t> region;  ///< for each site: index of its region in `regions`
    std::vector<std::string> regions;   ///< names of the regions; at least one
    double area = 0;                    ///< area of skin that one site represents, m2; 0: sites are separate sensors

    std::size_t size() const { return positions.size(); }
    /// Adds a site, and its region if it is new.
    void add(const Position&, std::string name, const std::string& region_name);
};

/// A grid of sites `pitch` (m) apart, named "r1c1", "r1c2" ... in their order. Site "r1c1" is at the lower left; further rows are above it.
Result<Sites> grid_sites(std::size_t rows, std::size_t columns, double pitch);

/// One site for each channel of a recording, at the channel's position in the layout. A channel without a position is an error.
Result<Sites> channel_sites(std::span<const Channel>);

}  // namespace corpuscle
