#pragma once
// From force at the sites to what the units of one class feel: the receptive fields at work.

#include "model/lanes/buffer.hpp"
#include "model/population.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// Steps that go through a skin at once: a tile's force over them, and what it is summed up in, stay in the caches.
inline constexpr std::size_t skin_steps = 32;

/// Sums are in the order of the sites, and a site without force adds nothing to them: the same bits whoever lists which sites are touched.
class FeltForce {
public:
    /// Of units [first, first + count) of a class.
    FeltForce(const ReceptiveFields&, std::size_t first, std::size_t count, std::size_t sites);

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

    /// The same of a tile, unit by unit: a site with its weight for each of its units, then another for each ... [k][unit]; a weight of
    /// 0 where a unit feels fewer. For single steps, which live skins take, and where much of the skin is touched.
    struct Tile {
        std::size_t most = 0;             ///< k
        std::vector<std::ptrdiff_t> row;  ///< if the sites at each k stand in a row: its first, which may be before all sites
        lanes::Buffer<std::uint32_t> site;
        std::vector<std::uint32_t> weights;  ///< of eight units each, by their place among all there are: [k][unit / 8]
    };
    struct Call {
        const SiteForce& force;
        std::span<const std::uint32_t> touched;
        std::size_t at, steps;
    };

    std::size_t units_, tiles_;
    std::vector<Piece> pieces_;
    lanes::Buffer<double> weights_;         // by eights, each that there is once
    std::vector<Tile> unit_by_unit_;        // made when it is first wanted
    std::vector<std::size_t> reach_begin_;  // with it: which tiles feel a site
    std::vector<std::uint32_t> reach_;
    std::vector<double> now_;               // force of all sites at a single step, between zeros
    std::vector<const double*> site_rows_;  // of all sites over some steps, likewise; zeros where nothing touches
    lanes::Buffer<double> rows_;
    std::vector<std::uint8_t> without_;
    std::vector<lanes::Buffer<double>> sums_;  // of each thread: [unit of a piece][step]

    void feel_piece(std::size_t piece, const Call&, double* sums);
    void make_unit_by_unit();
    class Eights;
    void make_tile(std::size_t tile, std::size_t sites, Eights&);
    void find_touched_tiles(const Call&);
    void feel_one_step(const Call&);
    void feel_unit_by_unit(const Call&, Pool&);
};

}  // namespace corpuscle
