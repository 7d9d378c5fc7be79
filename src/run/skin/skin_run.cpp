#include "run/skin/skin_run.hpp"

#include <chrono>

namespace corpuscle {
namespace {

class LocalSimulator final : public SkinSimulator {
    Skin& skin_;
    ThreadPool& pool_;

public:
    LocalSimulator(Skin& skin, ThreadPool& pool) : skin_(skin), pool_(pool) {}
    Result<void> respond(const SiteForce& force, std::size_t steps, std::vector<Spike>& spikes) override {
        return skin_.respond(force, steps, spikes, pool_);
    }
    Result<void> flush(std::vector<Spike>& spikes) override { return skin_.finish(spikes), Result<void>{}; }
    SkinStats stats() const override { return skin_.stats(); }
};

/// Limits how often the log is flushed. The interval is so long that the cost of flushing is negligible.
class FlushTimer {
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    static constexpr std::chrono::seconds interval{10};

public:
    /// True at most once in each interval.
    bool is_due() {
        const auto t = std::chrono::steady_clock::now();
        if (t - last_ < interval) return false;
        last_ = t;
        return true;
    }
};

/// Gets the spikes of one block, which begins with sample `first`: from the log if an earlier run has simulated it, otherwise by
/// simulation.
Result<void> run_block(const SkinForce::Block& block, std::int64_t first, SkinSimulator& skin, SkinRunLog* run_log,
                       std::vector<Spike>& spikes) {
    spikes.clear();
    const auto steps = block.total_force.size();
    if (run_log && first < run_log->resumed_samples()) return run_log->replay(first + static_cast<std::int64_t>(steps), spikes);
    if (auto ok = skin.respond(block.force, steps, spikes); !ok) return ok;
    return run_log ? run_log->append(spikes) : Result<void>{};
}

}  // namespace

std::unique_ptr<SkinSimulator> local_skin_simulator(Skin& skin, ThreadPool& pool) { return std::make_unique<LocalSimulator>(skin, pool); }

Result<SkinStats> run_skin(SkinForce& force, const SkinInput& input, SkinSimulator& skin, std::span<SkinSink* const> sinks,
                           const SkinRunOptions& options) {
    for (auto* sink : sinks)
        if (auto ok = sink->begin(input); !ok) return ok.error();
    std::vector<Spike> spikes;
    std::int64_t samples = 0;
    FlushTimer flush_timer;
    for (;;) {
        auto block = force.next();
        if (!block) return block.error();
        const std::size_t steps = block->total_force.size();
        if (steps == 0) break;
        if (options.log)
            if (auto ok = options.log->add_force(*block, samples); !ok) return ok.error();
        if (auto ok = run_block(*block, samples, skin, options.log, spikes); !ok) return ok.error();
        for (auto* sink : sinks)
            if (auto ok = sink->block(input, {samples, steps, block->force, block->total_force, spikes}); !ok) return ok.error();
        samples += static_cast<std::int64_t>(steps);
        const bool stop = !options.should_continue(force.progress());
        if (options.log && samples > options.log->resumed_samples() && (stop || flush_timer.is_due()))
            if (auto ok = options.log->flush(); !ok) return ok.error();
        if (stop) return Error{ErrorCode::interrupted, "interrupted"};
    }
    if (samples == 0) return bad_input("no samples of force", {input.name});
    if (options.log)
        if (auto ok = options.log->finish(samples); !ok) return ok.error();
    spikes.clear();
    if (auto ok = skin.flush(spikes); !ok) return ok.error();
    for (auto* sink : sinks)
        if (auto ok = sink->end(input, samples, spikes); !ok) return ok.error();
    return skin.stats();
}

}  // namespace corpuscle
