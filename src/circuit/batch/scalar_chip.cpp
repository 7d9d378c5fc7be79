// Simulates one chip of a batch by the scalar code, as an afferent.

#include "circuit/batch/chip_batch.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t samples_per_block = 256;

/// Simulates a chip block by block. The response of the afferent lags the force by delay() samples, so the force is continued by as many.
class ScalarRun {
    const Chip& chip_;
    const BatchOptions& options_;
    ChipResponse& out_;
    std::unique_ptr<Afferent> afferent_;
    State state_;
    std::vector<Spike> spikes_;
    std::vector<std::vector<double>> probes_;  // [probe][sample of the block]
    std::vector<double*> rows_;                // the rows of probes_

    /// Records the probes of a block of `count` samples, the first with number `first`; numbers below 0 are before the force.
    void record_probes(std::int64_t first, std::size_t count) {
        const auto every = static_cast<std::int64_t>(options_.probe_every), end = static_cast<std::int64_t>(chip_.force.size());
        for (std::size_t p = 0; p < probes_.size(); ++p)
            for (std::size_t k = 0; k < count; ++k)
                if (const auto sample = first + static_cast<std::int64_t>(k); sample >= 0 && sample < end && sample % every == 0)
                    out_.probes[p].push_back(static_cast<float>(probes_[p][k]));
    }

public:
    ScalarRun(const Chip& chip, const BatchOptions& options, ChipResponse& out)
        : chip_(chip), options_(options), out_(out), afferent_(chip.design->make(chip.T, chip.sample)), state_(afferent_->start()) {
        out.range_violations.resize(afferent_->ranges().size());
        if (options.probe_every == 0) return;
        probes_.assign(afferent_->probes().size(), std::vector<double>(samples_per_block));
        for (auto& p : probes_) rows_.push_back(p.data());
        out.probes.resize(probes_.size());
    }

    Result<void> run() {
        std::vector<double> force(chip_.force.begin(), chip_.force.end());
        force.insert(force.end(), static_cast<std::size_t>(afferent_->delay()), force.back());
        for (std::size_t at = 0; at < force.size() && !out_.hit_iteration_limit; at += samples_per_block) {
            if (options_.should_stop && options_.should_stop()) return Error{ErrorCode::interrupted, "interrupted"};
            const auto count = std::min(samples_per_block, force.size() - at);
            const auto first = state_.step - afferent_->delay();
            ResponseBlock block_response{spikes_, 0, rows_, out_.range_violations};
            auto done = afferent_->respond(std::span(force).subspan(at, count), state_, block_response);
            out_.stats.steps += block_response.steps, out_.stats.rejected += block_response.rejected_steps,
                out_.stats.iterations += block_response.newton_iterations;
            out_.energy_use += block_response.energy_use;
            if (!done) return done;
            record_probes(first, count);
            out_.hit_iteration_limit = options_.max_iterations > 0 && out_.stats.iterations > options_.max_iterations;
        }
        return {};
    }

    void report_spikes() {
        const auto end = static_cast<std::int64_t>(chip_.force.size());
        for (const auto& spike : spikes_)
            if (spike.step <= end) out_.spikes.push_back((static_cast<double>(spike.step - 1) + spike.offset) * chip_.T);
    }
};

}  // namespace

ChipResponse run_chip_scalar(const Chip& chip, const BatchOptions& options) {
    ChipResponse out;
    ScalarRun run(chip, options, out);
    if (auto done = run.run(); !done) out.error = done.error();
    run.report_spikes();
    return out;
}

}  // namespace corpuscle::circuit
