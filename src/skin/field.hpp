#pragma once
// From force at the sites to what the units of one class feel: the receptive fields at work.

#include <optional>

#include "model/lanes/buffer.hpp"
#include "model/population.hpp"
#include "skin/field_units.hpp"
#include "skin/lanes/kernel.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// Steps that go through a skin at once: a tile's force over them, and what it is summed up in, stay in the caches.
inline constexpr std::size_t skin_steps = 32;

/// Sums are in the order of the sites, and a site without force adds nothing to them: the same bits whoever lists which sites are touched.
class FeltForce {
public:
    /// Of units [first, first + count) of a class.
    FeltForce(const ReceptiveFields&, std::size_t first, std::size_t count, std::size_t sites, InstructionSet);

    /// Some steps, at most skin_steps, from `at` of the block on.
    void feel(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, Pool&);

    ForceTiles<double> tiles() const { return {rows_.data(), without_.data()}; }

private:
    static constexpr std::size_t piece_tiles = 16;  // for one thread
    /// The weights of the units of a piece, site by site.
    struct Piece {
        std::vector<std::uint32_t> begin, unit;
        std::vector<double> weight;
    };

    /// The same of a tile whose units stand as the sites do, as on a grid: [k][unit], where the sites of one k stand in a row, too; a
    /// weight of 0 where a unit does not feel its site. For single steps, which live skins take.
    struct OneStep {
        std::vector<std::ptrdiff_t> row;     ///< of each k the first site, which may be before all sites; none: they do not stand so
        std::vector<std::uint32_t> weights;  ///< of eight units each, by their place among all there are: [k][unit / 8]
    };
    struct Call {
        const SiteForce& force;
        std::span<const std::uint32_t> touched;
        std::size_t at, steps;
    };

    const lanes::FieldLanes& lanes_;
    std::size_t units_, tiles_;
    std::vector<Piece> pieces_;
    lanes::Buffer<double> weights_;         // by eights, each that there is once
    std::vector<OneStep> one_step_;         // of each tile; made when a single step comes
    std::vector<std::uint8_t> in_rows_;     // with it: whether all tiles of a piece stand so
    std::vector<std::size_t> reach_begin_;  // with it: which tiles feel a site
    std::vector<std::uint32_t> reach_;
    std::vector<double> now_;               // force of all sites at that step, between zeros
    std::optional<FieldsByUnit> by_unit_;   // made when much of the skin is touched
    std::vector<const double*> site_rows_;  // of all sites over some steps
    lanes::Buffer<double> rows_;
    std::vector<std::uint8_t> without_;
    std::vector<lanes::Buffer<double>> sums_;  // of each thread: [unit of a piece][step]

    void feel_piece(std::size_t piece, const Call&, double* sums);
    void make_by_unit();
    void feel_by_unit(const Call&, Pool&);
    void make_one_step();
    class Eights;
    void make_tile(std::size_t tile, std::size_t sites, Eights&);
    void feel_one_step(const Call&);
    void feel_in_rows(std::size_t piece, const double* now);
    void feel_site_by_site(std::size_t piece, const Call&);
};

}  // namespace corpuscle
