#pragma once
// Simulates a skin as the input of a run: in this process, or divided among MPI ranks. Each rank simulates a part of the afferents of every
// class, and computes the force on the skin itself. Rank 0 (the coordinator) gathers the spikes of the other ranks (the workers) block by
// block and writes the files. A run with a checkpoint can be resumed.

#include <chrono>
#include <optional>

#include "model/copies.hpp"
#include "run/ranks.hpp"
#include "run/run_inputs.hpp"
#include "run/skin/skin_checkpoint.hpp"
#include "run/skin/skin_population.hpp"
#include "skin/wave/contact_wave.hpp"

namespace corpuscle {

/// Records currents and membranes of a skin. Lanes record no probes, so each afferent is simulated a second time, individually, under the
/// same force; its spikes are the same bit for bit.
class SkinProbes {
public:
    static constexpr std::size_t max_afferents = 50;  ///< largest number of afferents of a class

    /// Returns an error if a class has more than max_afferents afferents.
    static Result<SkinProbes> make(const Innervation&, const SimulationOptions&);
    /// The probes of each class.
    std::vector<std::span<const Probe>> class_probes() const;
    /// Simulates the next block.
    Result<void> respond(const SiteForce&, std::size_t steps, ThreadPool&);
    /// [afferent][probe][sample] of the last block.
    std::span<const std::vector<std::vector<double>>> values() const { return values_; }

private:
    const Innervation* skin_ = nullptr;
    std::vector<std::unique_ptr<Afferent>> afferents_;
    std::vector<State> states_;
    std::vector<std::unique_ptr<ContactWave>> waves_;  // of each class; null: none
    std::vector<std::uint32_t> touched_;
    std::vector<std::vector<double>> force_;  // on each afferent in the current block, N
    std::vector<std::vector<double>> sums_;   // one component of it, summed over the receptive field of each afferent, N
    std::vector<std::vector<std::vector<double>>> values_;

    void sum_component(const SiteForce&, const double* component, std::size_t steps);
    void compute_force(const SiteForce&, std::size_t steps);
    void add_waves(const SiteForce&, std::size_t steps, ThreadPool&);
};

class SkinSimulator final : public BlockSimulator {
public:
    /// `input`: name, clock and so on; its population must be `population`. `skin`: the afferents that this process simulates.
    /// `checkpoint`: null if the run cannot be resumed. `ranks`: of which this process is rank 0; null: a single process.
    SkinSimulator(SkinPopulation& population, Input input, SkinForce& force, Skin& skin, SkinCheckpoint* checkpoint = nullptr,
                  Ranks* ranks = nullptr)
        : population_(population), input_(std::move(input)), force_(force), skin_(skin), checkpoint_(checkpoint), ranks_(ranks) {}

    Result<void> start(const RespondOptions&, bool wants_probes) override;
    const Input& input() const override { return input_; }
    Result<RunBlock> next(ThreadPool&, RunStats&) override;
    double progress() const override { return force_.progress(); }
    Result<void> save(bool stops) override;
    Result<void> finish(std::vector<Spike>&, RunStats&) override;

private:
    SkinPopulation& population_;
    Input input_;
    SkinForce& force_;
    Skin& skin_;
    SkinCheckpoint* checkpoint_;
    Ranks* ranks_;
    std::optional<SkinProbes> probes_;
    std::int64_t samples_ = 0;   // before the next block
    std::vector<Spike> spikes_;  // of the current block
    std::span<const double> total_force_;
    std::chrono::steady_clock::time_point last_save_ = std::chrono::steady_clock::now();

    Result<void> simulate(const SkinForce::Block&, ThreadPool&);
};

/// For a worker: simulates until the force ends, and sends everything to rank 0. `force`: the force, or the error that prevented its
/// preparation, in which case `skin` may be null.
void run_skin_worker(Ranks&, Result<SkinForce*> force, Skin* skin, ThreadPool&);

}  // namespace corpuscle
