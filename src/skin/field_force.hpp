#pragma once
// Applies receptive fields: computes the force on the afferents of one class from the force at the sites.

#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"
#include "skin/field_pieces.hpp"
#include "skin/lanes/kernel.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// The largest number of steps that a skin simulates at once. It is so small that the force on a tile in these steps stays in the caches.
inline constexpr std::size_t skin_steps = 32;

/// The index in ForceTiles of the force on a receptor. `number` is as in ReceptiveFields::afferent, but counted from the first tile.
inline std::size_t index_in_tiles(std::size_t number, std::size_t receptors) {
    const std::size_t afferent = number / receptors;
    return (afferent / tile_width * receptors + number % receptors) * tile_width + afferent % tile_width;
}

/// Computes the force on the afferents of one class. If each has several receptors, there is a force for each receptor, and the tiles are
/// those of ForceTiles for several forces. "Afferent" then means one receptor of an afferent. The force on an afferent is a weighted sum
/// over sites, whose terms are always added in the order of the sites. A site without force adds exactly 0. So the result is the same bit
/// for bit whether or not such sites are among the touched ones.
class FieldForce {
public:
    /// For afferents [first, first + count) of a class. The receptive fields must outlive this object.
    FieldForce(const ReceptiveFields&, std::size_t first, std::size_t count, InstructionSet);

    /// Computes the force in `steps` steps, at most skin_steps, from step `at` of the block on. tiles() returns the result.
    void compute(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, ThreadPool&);

    ForceTiles<double> tiles() const { return {rows_.data(), zero_force_.data()}; }

private:
    static constexpr std::size_t tiles_per_piece = 16;  // tiles in a piece; a piece is computed by one thread
    /// The weights of a tile for single steps, which live skins simulate. They are only built if the tile's afferents are arranged like the
    /// sites, as on a grid. Row k has one weight for each afferent u of the tile, for the force at site row[k] + u. The weight is 0 if the
    /// afferent does not respond to this site.
    struct OneStep {
        std::vector<std::ptrdiff_t> row;     ///< for each row the site of afferent 0; may be negative; empty: not built
        std::vector<std::uint32_t> weights;  ///< [row][u / 8]: index in weights_ of the first of eight weights
    };
    /// The receptive fields sorted by afferent, for use when a large part of the skin is touched. The force on one afferent is then summed
    /// completely, in registers, which is faster than adding the contribution of each site to the sums of many afferents.
    struct FieldsByAfferent {
        std::vector<std::size_t> begin;  ///< for each afferent: index of its first entry in `site` and `weight`; then the number of entries
        std::vector<std::uint32_t> site;  ///< in ascending order for each afferent
        std::vector<double> weight;
    };
    /// The arguments of compute().
    struct Call {
        const SiteForce& force;
        std::span<const std::uint32_t> touched;
        std::size_t at, steps;
    };

    const lanes::FieldKernels& lanes_;
    FieldPieces pieces_;
    std::size_t size_, tiles_;                        // numbers of afferents and of tiles
    lanes::AlignedBuffer<double> weights_;            // groups of eight weights of OneStep, each distinct group once
    std::vector<OneStep> one_step_;                   // for each tile; built at the first single step
    std::vector<std::uint8_t> has_rows_;              // for each piece: 1 if all its tiles have rows; built with one_step_
    std::vector<std::size_t> responding_begin_;       // for each site: index of its first tile in responding_tiles_; built with one_step_
    std::vector<std::uint32_t> responding_tiles_;     // the tiles with afferents that respond to a site, site by site
    std::vector<double> padded_force_;                // for a single step: force at all sites, with zeros before and after
    FieldsByAfferent by_afferent_;                    // built when a large part of the skin is first touched; empty before
    std::vector<const double*> site_rows_;            // for each site: its force in the steps of the call
    lanes::AlignedBuffer<double> rows_;               // result: ForceTiles::rows
    std::vector<std::uint8_t> zero_force_;            // result: ForceTiles::zero_force
    std::vector<lanes::AlignedBuffer<double>> sums_;  // for each thread: [afferent of a piece][step]

    void compute_piece(std::size_t piece, const Call&, double* sums);
    void build_by_afferent();
    void compute_by_afferent(const Call&, ThreadPool&);
    void compute_tile(std::size_t tile, std::size_t steps);
    void build_one_step();
    class WeightGroups;
    void build_tile(std::size_t tile, WeightGroups&);
    void compute_one_step(const Call&);
    void compute_rows(std::size_t piece, const double* force_at_site_0);
    void compute_site_by_site(std::size_t piece, const Call&);
};

}  // namespace corpuscle
