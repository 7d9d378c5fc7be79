// Simulates one chip of a batch by the scalar code, as an afferent.

#include "circuit/batch/chip_batch.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t samples_per_block = 256;

/// Records the probes of a block of `count` samples, the first with number `first`; numbers below 0 are before the force.
void record_probes(const Chip& chip, std::int64_t every, const std::vector<std::vector<double>>& probes, std::int64_t first,
                   std::size_t count, ChipResponse& out) {
    const auto end = static_cast<std::int64_t>(chip.force.size());
    for (std::size_t p = 0; p < probes.size(); ++p)
        for (std::size_t k = 0; k < count; ++k)
            if (const auto sample = first + static_cast<std::int64_t>(k); sample >= 0 && sample < end && sample % every == 0)
                out.probes[p].push_back(static_cast<float>(probes[p][k]));
}

/// Simulates a chip block by block. The response of the afferent lags the force by delay() samples, so the force is continued by as many.
Result<void> simulate(const Chip& chip, const BatchOptions& options, std::vector<Spike>& spikes, ChipResponse& out) {
    const auto afferent = chip.design->make(chip.T, chip.sample);
    auto state = afferent->start();
    out.range_violations.resize(afferent->ranges().size());
    out.probes.resize(options.probe_every == 0 ? 0 : afferent->probes().size());
    std::vector<std::vector<double>> probes(out.probes.size(), std::vector<double>(samples_per_block));  // [probe][sample of the block]
    std::vector<double*> rows;
    for (auto& p : probes) rows.push_back(p.data());
    std::vector<double> force(chip.force.begin(), chip.force.end());
    force.insert(force.end(), static_cast<std::size_t>(afferent->delay()), force.back());
    for (std::size_t at = 0; at < force.size() && !out.hit_iteration_limit; at += samples_per_block) {
        const auto count = std::min(samples_per_block, force.size() - at);
        const auto first = state.step - afferent->delay();
        ResponseBlock block{spikes, 0, rows, out.range_violations};
        block.should_stop = options.should_stop;
        const auto done = afferent->respond(std::span(force).subspan(at, count), state, block);
        out.stats.steps += block.steps, out.stats.rejected += block.rejected_steps, out.stats.iterations += block.newton_iterations;
        out.energy_use += block.energy_use;
        if (!done) return done;
        record_probes(chip, static_cast<std::int64_t>(options.probe_every), probes, first, count, out);
        out.hit_iteration_limit = options.max_iterations > 0 && out.stats.iterations > options.max_iterations;
    }
    return {};
}

}  // namespace

ChipResponse run_chip_scalar(const Chip& chip, const BatchOptions& options) {
    ChipResponse out;
    std::vector<Spike> spikes;
    if (auto done = simulate(chip, options, spikes, out); !done) out.error = done.error();
    for (const auto& spike : spikes)
        if (spike.step <= static_cast<std::int64_t>(chip.force.size()))
            out.spikes.push_back((static_cast<double>(spike.step - 1) + spike.offset) * chip.T);
    return out;
}

}  // namespace corpuscle::circuit
