#include "run/skin/skin_simulator.hpp"

#include <utility>

namespace corpuscle {
namespace {

/// Checkpoints are so far apart that the cost of saving is negligible.
constexpr std::chrono::seconds save_interval{10};

}  // namespace

Result<void> SkinSimulator::start(const RespondOptions& options, bool wants_probes) {
    if (!wants_probes) return {};
    probes_ = TRY(SkinProbes::make(skin_.innervation(), options.for_clock(input_.clock)));
    population_.set_probes(probes_->class_probes());
    return {};
}

/// Computes the spikes of a block or, if an earlier run has simulated it, reads them from the checkpoint.
Result<void> SkinSimulator::simulate(const SkinForce::Block& block, ThreadPool& pool) {
    spikes_.clear();
    const auto steps = block.total_force.size();
    auto* const checkpoint = parts_.checkpoint;
    if (checkpoint) TRY(checkpoint->add_force(block, samples_));
    if (checkpoint && samples_ < checkpoint->resumed_samples())
        return checkpoint->replay(samples_ + static_cast<std::int64_t>(steps), spikes_);
    TRY(skin_.respond(block.force, steps, spikes_, pool));
    if (parts_.ranks) TRY(gather_spikes(*parts_.ranks, spikes_));
    return checkpoint ? checkpoint->append(spikes_) : Result<void>{};
}

Result<RunBlock> SkinSimulator::next(ThreadPool& pool, RunStats&) {
    const auto block = TRY(force_.next());
    const auto steps = block.total_force.size();
    if (steps == 0) return RunBlock{};
    TRY(simulate(block, pool));
    if (probes_) TRY(probes_->respond(block.force, steps, pool));
    total_force_ = block.total_force;
    const auto first = std::exchange(samples_, samples_ + static_cast<std::int64_t>(steps));
    RunBlock response{first, steps, {&total_force_, 1}, block.force, spikes_};
    if (probes_) response.probes = probes_->values();
    return response;
}

Result<void> SkinSimulator::save(bool stops) {
    auto* const checkpoint = parts_.checkpoint;
    if (!checkpoint || samples_ <= checkpoint->resumed_samples()) return {};
    const auto now = std::chrono::steady_clock::now();
    if (!stops && now - last_save_ < save_interval) return {};
    last_save_ = now;
    return checkpoint->flush();
}

Result<void> SkinSimulator::finish(std::vector<Spike>& last, RunStats& stats) {
    if (parts_.checkpoint) TRY(parts_.checkpoint->finish(samples_));
    skin_.finish(last);
    auto work = skin_.stats();
    if (parts_.ranks) {
        TRY(gather_spikes(*parts_.ranks, last));
        TRY(gather_stats(*parts_.ranks, work));
    }
    stats.samples += work.steps, stats.afferent_steps += work.afferent_steps, stats.skipped_steps += work.skipped_steps;
    stats.spikes += work.spikes, stats.truncated_steps += work.truncated_steps;
    input_.quality = force_.quality();
    return {};
}

}  // namespace corpuscle
