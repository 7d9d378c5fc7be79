#pragma once
// Receptive fields in use: from the force at the sites to the force on the afferents of one class.

#include <optional>

#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"
#include "skin/fields_by_afferent.hpp"
#include "skin/lanes/kernel.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// Steps that pass through a skin at once. The force on a tile and its sums over these steps stay in the caches.
inline constexpr std::size_t skin_steps = 32;

/// Sums run in the order of the sites, and a site without force adds nothing. The result is therefore the same bit for bit, for any list
/// of touched sites.
class FieldForce {
public:
    /// For afferents [first, first + count) of a class.
    FieldForce(const ReceptiveFields&, std::size_t first, std::size_t count, std::size_t sites, InstructionSet);

    /// Computes the force for `steps` steps, at most skin_steps, from step `at` of the block.
    void compute(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, ThreadPool&);

    ForceTiles<double> tiles() const { return {rows_.data(), zero_force_.data()}; }

private:
    static constexpr std::size_t tiles_per_piece = 16;  // for one thread
    /// The weights of the afferents of a piece, site by site.
    struct Piece {
        std::vector<std::uint32_t> begin, afferent;
        std::vector<double> weight;
    };

    /// The weights of a tile whose afferents are arranged like the sites, as on a grid: [k][afferent], where the sites of one k are
    /// consecutive, too. The weight is 0 where an afferent does not respond to its site. Used for single steps, as live skins take them.
    struct OneStep {
        std::vector<std::ptrdiff_t> row;     ///< for each k the first site, which may lie before all sites; empty: not so arranged
        std::vector<std::uint32_t> weights;  ///< indices of groups of eight weights among all distinct groups: [k][afferent / 8]
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
    std::vector<std::uint8_t> has_rows_;         // of each piece, built with it: 1 if all its tiles are so arranged
    std::vector<std::size_t> responding_begin_;  // built with it: the tiles that respond to each site
    std::vector<std::uint32_t> responding_tiles_;
    std::vector<double> padded_force_;             // force of all sites at that step, between zeros
    std::optional<FieldsByAfferent> by_afferent_;  // built when a large part of the skin is touched
    std::vector<const double*> site_rows_;         // of all sites over some steps
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
