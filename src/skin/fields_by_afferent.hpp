#pragma once
// Receptive fields stored afferent by afferent, for use when a large part of the skin is touched. The sum of one afferent is computed
// completely, in registers. This is faster than adding the contribution of each site to many sums.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skin/lanes/kernel.hpp"

namespace corpuscle {

class FieldsByAfferent {
public:
    FieldsByAfferent(std::size_t size, const lanes::FieldKernels& lanes) : lanes_(lanes), begin_(size + 1) {}
    /// First call count_site() for each site of each afferent, then finish_counts(), then add() in the order of the sites.
    void count_site(std::size_t afferent) { ++begin_[afferent + 1]; }
    void finish_counts();
    void add(std::size_t afferent, std::uint32_t site, double weight);

    /// Computes the force on the afferents of a tile over some steps and writes it to rows[step][afferent]. site_rows[s] is the force of
    /// site s over these steps. The sums equal those of the other methods bit for bit.
    void compute_tile(std::size_t tile, std::span<const double* const> site_rows, std::size_t steps, double* rows) const;

private:
    const lanes::FieldKernels& lanes_;
    std::vector<std::size_t> begin_, filled_;
    std::vector<std::uint32_t> site_;
    std::vector<double> weight_;
};

}  // namespace corpuscle
