#pragma once
// The sites of a skin: the points on a plane where force is applied.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "signal/force_source.hpp"

namespace corpuscle {

inline constexpr std::size_t max_sites = std::size_t{1} << 22;

/// Sites of one skin. x points to the right, y away from the wrist. A hand is a right hand in palm view.
struct Sites {
    std::vector<Position> positions;    ///< m
    std::vector<std::string> names;     ///< one for each site
    std::vector<std::uint32_t> region;  ///< of each site: index into `regions`
    std::vector<std::string> regions;   ///< at least one
    double area = 0;                    ///< area of skin that one site represents, m2; 0: sites are separate sensors

    std::size_t size() const { return positions.size(); }
};

/// A grid of sites `pitch` (m) apart, the first at the lower left, row after row upwards: "r1c1", "r1c2" ...
Result<Sites> grid_sites(std::size_t rows, std::size_t columns, double pitch);

/// The channels of a recording, at the positions in its layout. Refuses a channel without a position.
Result<Sites> channel_sites(std::span<const Channel>);

}  // namespace corpuscle
