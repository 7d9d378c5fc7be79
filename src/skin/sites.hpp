#pragma once
// Where force is felt: the sensor sites of a skin, on a plane.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "signal/source.hpp"

namespace corpuscle {

inline constexpr std::size_t most_sites = std::size_t{1} << 22;

/// Sites of one skin. x points to the right, y away from the wrist; of a hand, as one sees the own right palm.
struct Sites {
    std::vector<Position> at;           ///< m
    std::vector<std::string> names;     ///< one a site
    std::vector<std::uint32_t> region;  ///< of each, by its place in `regions`
    std::vector<std::string> regions;   ///< at least one
    double area = 0;                    ///< m2 of skin that one site stands for; 0: sensors that stand as they stand

    std::size_t size() const { return at.size(); }
};

/// Rows by columns, `pitch` (m) apart, the first at the lower left, row after row upwards: "r1c1", "r1c2" ...
Result<Sites> grid_sites(std::size_t rows, std::size_t columns, double pitch);

/// A recording's own channels, where its layout says they sit. Refuses a channel without a place.
Result<Sites> channel_sites(std::span<const Channel>);

}  // namespace corpuscle
