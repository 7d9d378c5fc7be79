#pragma once
// The contact wave of one class: a change of force anywhere on the skin travels through it, and reaches an afferent delayed and weaker.
//     W(t) = sum over touched cells of w(r) G(t - r/c),   w(r) = gain exp(-r/decay) / (1 + r/radius)^(1/2)
// G is the change of the force on a cell (WaveSources), r the distance from this cell to that of the afferent, c the speed. Times between
// samples are interpolated linearly, which weakens frequencies near half the sampling rate. Sources of the form: speed, TouchSim
// (Saal et al. 2017; hsaal/touchsim, touchsim/transduction.py: 8 m/s, and no delay under the probe); exponential decay and spreading with
// the root of the distance, a choice after Manfredi 2012 and Shao 2016 (from memory).
// It carries normal force only. Left out: frequency-dependent speed and decay, and that a wave between fingers has to travel through the
// palm: distances are straight.

#include "core/number/instruction_set.hpp"
#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"
#include "skin/lanes/kernel.hpp"
#include "skin/wave/wave_sources.hpp"

namespace corpuscle {

class ContactWave {
public:
    /// For afferents [first, first + count) of a class, whose wave has a speed. An error if the wave needs too much memory at this rate.
    static Result<std::unique_ptr<ContactWave>> make(const Innervation&, std::size_t class_index, std::size_t first, std::size_t count,
                                                     double dt, InstructionSet);

    /// Computes the wave in `steps` steps, at most WaveSources::max_steps, from step `at` of the block on.
    void compute(const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, ThreadPool&);
    /// The wave's force on an afferent, counted from 0 at `first`, in the steps of the last call; null: 0.
    const double* force_on(std::size_t afferent) const {
        const auto cell = cell_of_afferent_[afferent];
        return has_wave_[cell] ? waves_.data() + cell * WaveSources::max_steps : nullptr;
    }
    /// The same, added to the force on the afferents from their receptive fields, and to each force of afferents with several. The result
    /// is valid until the next call.
    ForceTiles<double> add(ForceTiles<double> direct, const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at,
                           std::size_t steps, ThreadPool&);

    std::vector<double> save() const { return sources_.save(); }
    /// `step`: number of samples simulated so far. False if the values do not belong to this wave.
    bool resume(std::span<const double> saved, std::int64_t step) { return sources_.resume(saved) && sources_.step() == step; }

private:
    /// The path of a wave between two cells: weights of the samples `delay` and `delay + 1` steps ago; both 0: no wave arrives.
    struct Path {
        std::int64_t delay = 0;
        double weight = 0, weight_before = 0;
    };
    /// The paths between any two cells, by the number of columns and rows between them.
    struct Paths {
        std::int32_t columns = 0, rows = 0;  ///< the largest distance from the first to the last path
        std::vector<Path> paths = {};        ///< [columns][rows]
        std::int64_t max_delay = 0;
        Paths(const WaveParams&, std::int32_t columns, std::int32_t rows, double dt);
        const Path* between(const WaveCell&, const WaveCell&) const;  ///< null: no wave arrives
    };

    /// The arguments of add() for each tile.
    struct TileCall {
        ForceTiles<double> direct;
        std::size_t steps;
    };

    const lanes::FieldKernels& lanes_;
    std::size_t receptors_;  // of an afferent
    Paths paths_;
    WaveSources sources_;
    WaveCellList cells_;  // that have afferents
    std::vector<std::uint32_t> cell_of_afferent_;
    std::vector<char> has_wave_;                          // for each cell
    lanes::AlignedBuffer<double> waves_;                  // [cell][max_steps], N
    std::vector<std::vector<lanes::DelayedTerm>> terms_;  // for each thread
    lanes::AlignedBuffer<double> rows_;                   // result of add(): ForceTiles::rows
    std::vector<std::uint8_t> zero_force_;                // result of add(): ForceTiles::zero_force

    ContactWave(const Innervation&, std::size_t class_index, std::size_t first, std::size_t count, double dt, InstructionSet, Paths);
    void add_to_tile(std::size_t tile, const TileCall&);
    void compute_cell(std::size_t cell, std::size_t steps, std::vector<lanes::DelayedTerm>&);
};

}  // namespace corpuscle
