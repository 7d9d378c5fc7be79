#pragma once
// Receptive fields stored afferent by afferent, for use when a large part of the skin is touched. The force on one afferent is then
// summed completely, in registers, which is faster than adding the contribution of each site to the sums of many afferents.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skin/lanes/kernel.hpp"

namespace corpuscle {

class FieldsByAfferent {
public:
    /// `size`: number of afferents.
    FieldsByAfferent(std::size_t size, const lanes::FieldKernels& lanes) : lanes_(lanes), begin_(size + 1) {}
    /// To fill the table, first call count_site() for each site of each receptive field, then finish_counts(), then add() for each of them
    /// again, in the order of the sites.
    void count_site(std::size_t afferent) { ++begin_[afferent + 1]; }
    void finish_counts();
    void add(std::size_t afferent, std::uint32_t site, double weight);

    /// Computes the force on the afferents of a tile over `steps` steps and writes it to rows[step][tile_width]. site_rows[s] points to the
    /// force at site s in these steps. The sums equal those of FieldForce's other methods bit for bit.
    void compute_tile(std::size_t tile, std::span<const double* const> site_rows, std::size_t steps, double* rows) const;

private:
    const lanes::FieldKernels& lanes_;
    std::vector<std::size_t> begin_;   // for each afferent: index of its first entry in site_ and weight_; then the number of entries
    std::vector<std::size_t> filled_;  // for each afferent: index of the next entry that add() writes
    std::vector<std::uint32_t> site_;
    std::vector<double> weight_;
};

}  // namespace corpuscle
