#pragma once
// The cells of skin that send contact waves: keeps the change of the force on each cell for as long as the slowest wave travels.

#include "skin/skin.hpp"
#include "skin/wave/wave_cells.hpp"

namespace corpuscle {

/// A wave carries the change of force: the force on a cell after a high-pass of first order. So nothing is sent while a force is held, and
/// a cell is at rest some time after its last change. Changes below min_change are set to 0, which is exact for all block lengths because
/// it is done sample by sample.
class WaveSources {
public:
    static constexpr double min_change = 1e-12;  ///< N

    /// `corner`: of the high-pass, Hz. `history`: the number of past samples that are kept of every cell, at least 1.
    WaveSources(const Sites&, const WaveGrid&, double corner, double dt, std::size_t history);

    /// Adds a block of at most `max_steps` steps, from step `at` of the force on.
    void advance(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps);
    static constexpr std::size_t max_steps = 32;

    /// A cell whose change is not 0 in the last block or in the `history` samples before it.
    struct Source {
        WaveCell cell;
        const double* now;         ///< the change in the steps of the last block, N; the history is before it
        std::int64_t first, last;  ///< the samples of its first and last change; 0 outside. Samples count from the start of the skin
    };
    std::span<const Source> sources() const { return sources_; }
    std::size_t size() const { return state_.size(); }  ///< number of cells with sites
    std::int64_t step() const { return step_; }         ///< number of samples so far

    std::vector<double> save() const;
    /// False if the values are not those of such cells.
    bool resume(std::span<const double> saved);

private:
    struct Cell {
        double change = 0, force = 0;  ///< of the last sample, N: output and input of the high-pass
        std::int64_t first = 0, last = 0;
    };

    double decay_, gain_;  // of the high-pass, for each sample
    std::size_t history_, capacity_;
    WaveCellList cells_;
    std::vector<std::uint32_t> cell_of_site_;
    std::vector<Cell> state_;            // of each cell
    std::vector<char> is_active_;        // for each cell: 1 if it is in active_
    std::vector<std::uint32_t> active_;  // cells with a change in the history, or with force; ascending
    std::vector<double> changes_;        // [cell][capacity_]; only those of active cells are valid
    std::size_t end_;                    // position in changes_ after the last block
    std::int64_t step_ = 0;
    std::vector<Source> sources_;

    double* changes_of(std::size_t cell) { return changes_.data() + cell * capacity_; }
    bool is_at_rest(const Cell&) const;
    void activate(std::span<const std::uint32_t> touched);
    void filter(Cell&, double* values, std::size_t steps) const;
    void list_sources(std::size_t steps);
};

}  // namespace corpuscle
