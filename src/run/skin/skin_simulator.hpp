#pragma once
// Simulates a skin as the input of a run: in this process, or divided among MPI ranks. A run with a checkpoint can be resumed.

#include <chrono>
#include <optional>

#include "run/run_inputs.hpp"
#include "run/skin/skin_checkpoint.hpp"
#include "run/skin/skin_force.hpp"
#include "run/skin/skin_population.hpp"
#include "run/skin/skin_probes.hpp"
#include "run/skin/skin_ranks.hpp"

namespace corpuscle {

/// Parts that not every run of a skin has.
struct SkinRunParts {
    Ranks* ranks = nullptr;                ///< of which this process is rank 0; null: a single process
    SkinCheckpoint* checkpoint = nullptr;  ///< null: the run cannot be resumed
};

class SkinSimulator final : public BlockSimulator {
public:
    /// `input`: name, clock and so on; its population must be `population`. `skin`: the afferents that this process simulates.
    SkinSimulator(SkinPopulation& population, Input input, SkinForce& force, Skin& skin, SkinRunParts parts = {})
        : population_(population), input_(std::move(input)), force_(force), skin_(skin), parts_(parts) {}

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
    SkinRunParts parts_;
    std::optional<SkinProbes> probes_;
    std::int64_t samples_ = 0;   // before the next block
    std::vector<Spike> spikes_;  // of the current block
    std::span<const double> total_force_;
    std::chrono::steady_clock::time_point last_save_ = std::chrono::steady_clock::now();

    Result<void> simulate(const SkinForce::Block&, ThreadPool&);
};

}  // namespace corpuscle
