#pragma once
// Receptive fields in use: from the force at the sites to the force on the afferents of one class.

#include <optional>

#include "model/lanes/buffer.hpp"
#include "model/population.hpp"
#include "skin/field_units.hpp"
#include "skin/lanes/kernel.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// Steps that pass through a skin at once. The force on a tile and its sums over these steps stay in the caches.
inline constexpr std::size_t skin_steps = 32;

/// Sums run in the order of the sites, and a site without force adds nothing. The result is therefore the same bit for bit, whatever list
/// of touched sites is given.
class FeltForce {
public:
    /// For afferents [first, first + count) of a class.
    FeltForce(const ReceptiveFields&, std::size_t first, std::size_t count, std::size_t sites, InstructionSet);

    /// Computes the force for `steps` steps, at most skin_steps, from step `at` of the block.
    void feel(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, ThreadPool&);

    ForceTiles<double> tiles() const { return {rows_.data(), without_.data()}; }

private:
    static constexpr std::size_t piece_tiles = 16;  // for one thread
    /// The weights of the afferents of a piece, site by site.
    struct Piece {
        std::vector<std::uint32_t> begin, unit;
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

    const lanes::FieldLanes& lanes_;
    std::size_t units_, tiles_;
    std::vector<Piece> pieces_;
    lanes::Buffer<double> weights_;         // the distinct groups of eight weights
    std::vector<OneStep> one_step_;         // of each tile; built at the first single step
    std::vector<std::uint8_t> in_rows_;     // of each piece, built with it: 1 if all its tiles are so arranged
    std::vector<std::size_t> reach_begin_;  // built with it: the tiles that respond to each site
    std::vector<std::uint32_t> reach_;
    std::vector<double> now_;               // force of all sites at that step, between zeros
    std::optional<FieldsByUnit> by_unit_;   // built when a large part of the skin is touched
    std::vector<const double*> site_rows_;  // of all sites over some steps
    lanes::Buffer<double> rows_;
    std::vector<std::uint8_t> without_;
    std::vector<lanes::Buffer<double>> sums_;  // of each thread: [afferent of a piece][step]

    void feel_piece(std::size_t piece, const Call&, double* sums);
    void make_by_unit();
    void feel_by_unit(const Call&, ThreadPool&);
    void make_one_step();
    class Eights;
    void make_tile(std::size_t tile, std::size_t sites, Eights&);
    void feel_one_step(const Call&);
    void feel_in_rows(std::size_t piece, const double* now);
    void feel_site_by_site(std::size_t piece, const Call&);
};

}  // namespace corpuscle
