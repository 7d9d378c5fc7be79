#pragma once
// Applies receptive fields: computes the force on the afferents of one class from the force at the sites.

#include <optional>

#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"
#include "skin/fields_by_afferent.hpp"
#include "skin/lanes/kernel.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// Number of steps that a skin simulates at once. The force on a tile and its sums over these steps stay in the caches.
inline constexpr std::size_t skin_steps = 32;

/// The force on an afferent is a weighted sum over sites, always added in the order of the sites. A site without force adds nothing. The
/// result is therefore the same bit for bit, for any list of touched sites.
class FieldForce {
public:
    /// For afferents [first, first + count) of a class.
    FieldForce(const ReceptiveFields&, std::size_t first, std::size_t count, std::size_t sites, InstructionSet);

    /// Computes the force for `steps` steps, at most skin_steps, from step `at` of the block. tiles() returns the result.
    void compute(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, ThreadPool&);

    ForceTiles<double> tiles() const { return {rows_.data(), zero_force_.data()}; }

private:
    static constexpr std::size_t tiles_per_piece = 16;  // a thread computes whole pieces
    /// The weights of the afferents of a piece, site by site: entries [begin[s], begin[s + 1]) belong to site s.
    struct Piece {
        std::vector<std::uint32_t> begin, afferent;
        std::vector<double> weight;
    };

    /// The weights of a tile whose afferents are arranged like the sites, as on a grid. Row k has one weight for each afferent u of the
    /// tile, for the force at site row[k] + u. The weight is 0 if the afferent does not respond to this site. Used for single steps, which
    /// live skins simulate.
    struct OneStep {
        std::vector<std::ptrdiff_t> row;     ///< for each k the site of afferent 0; may be negative; empty: the tile is not so arranged
        std::vector<std::uint32_t> weights;  ///< indices of groups of eight weights in weights_: [k][u / 8]
    };
    struct Call {
        const SiteForce& force;
        std::span<const std::uint32_t> touched;
        std::size_t at, steps;
    };

    const lanes::FieldKernels& lanes_;
    std::size_t size_, tiles_;
    std::vector<Piece> pieces_;
    lanes::AlignedBuffer<double> weights_;       // the distinct groups of eight weights
    std::vector<OneStep> one_step_;              // of each tile; built at the first single step
    std::vector<std::uint8_t> has_rows_;         // of each piece: 1 if all its tiles have rows; built with one_step_
    std::vector<std::size_t> responding_begin_;  // of each site: where its tiles begin in responding_tiles_; built with one_step_
    std::vector<std::uint32_t> responding_tiles_;  // the tiles that respond to each site, site after site
    std::vector<double> padded_force_;             // force of all sites at a single step, with zeros before and after
    std::optional<FieldsByAfferent> by_afferent_;  // built when a large part of the skin is touched
    std::vector<const double*> site_rows_;         // for each site its force over the current steps
    lanes::AlignedBuffer<double> rows_;
    std::vector<std::uint8_t> zero_force_;
    std::vector<lanes::AlignedBuffer<double>> sums_;  // of each thread: [afferent of a piece][step]

    void compute_piece(std::size_t piece, const Call&, double* sums);
    void build_by_afferent();
    void compute_by_afferent(const Call&, ThreadPool&);
    void build_one_step();
    class WeightGroups;
    void build_tile(std::size_t tile, std::size_t sites, WeightGroups&);
    void compute_one_step(const Call&);
    void compute_rows(std::size_t piece, const double* now);
    void compute_site_by_site(std::size_t piece, const Call&);
};

}  // namespace corpuscle
