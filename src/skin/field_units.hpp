#pragma once
// Receptive fields unit by unit, for where much of a skin is touched: a unit's whole sum at a time, in registers, and not each site's
// share in many.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skin/lanes/kernel.hpp"

namespace corpuscle {

class FieldsByUnit {
public:
    FieldsByUnit(std::size_t units, const lanes::FieldLanes& lanes) : lanes_(lanes), begin_(units + 1) {}
    /// First how many sites each unit feels, then, in the order of the sites, which.
    void count(std::size_t unit) { ++begin_[unit + 1]; }
    void counted();
    void add(std::size_t unit, std::uint32_t site, double weight);

    /// What a tile's units feel over some steps, from the rows of all sites' force into rows [step][unit]. The sums of any other way, to
    /// the bit.
    void feel_tile(std::size_t tile, std::span<const double* const> site_rows, std::size_t steps, double* rows) const;

private:
    const lanes::FieldLanes& lanes_;
    std::vector<std::size_t> begin_, filled_;
    std::vector<std::uint32_t> site_;
    std::vector<double> weight_;
};

}  // namespace corpuscle
