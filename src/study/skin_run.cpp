#include "study/skin_run.hpp"

#include <chrono>

namespace corpuscle {
namespace {

class LocalSimulator final : public SkinAnswerer {
    Skin& skin_;
    ThreadPool& pool_;

public:
    LocalSimulator(Skin& skin, ThreadPool& pool) : skin_(skin), pool_(pool) {}
    Result<void> answer(const SiteForce& force, std::size_t steps, std::vector<Spike>& spikes) override {
        return skin_.respond(force, steps, spikes, pool_);
    }
    Result<void> last(std::vector<Spike>& spikes) override { return skin_.finish(spikes), Result<void>{}; }
    SkinStats work() const override { return skin_.stats(); }
};

/// Limits how often the log is flushed; the interval is long enough to make its cost negligible.
class FlushTimer {
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    static constexpr std::chrono::seconds interval{10};

public:
    bool is_due() {
        const auto t = std::chrono::steady_clock::now();
        if (t - last_ < interval) return false;
        last_ = t;
        return true;
    }
};

/// Gets the spikes of one block, by simulation or from the log.
Result<void> run_block(const SkinForce::Block& block, std::int64_t first, SkinAnswerer& skin, SkinSpool* spool,
                       std::vector<Spike>& spikes) {
    spikes.clear();
    const auto steps = block.total.size();
    if (spool && first < spool->step()) return spool->told(first + static_cast<std::int64_t>(steps), spikes);
    if (auto ok = skin.answer(block.force, steps, spikes); !ok) return ok;
    return spool ? spool->answered(spikes) : Result<void>{};
}

}  // namespace

std::unique_ptr<SkinAnswerer> alone_answerer(Skin& skin, ThreadPool& pool) { return std::make_unique<LocalSimulator>(skin, pool); }

Result<SkinStats> run_skin(SkinForce& force, const SkinInput& input, SkinAnswerer& skin, std::span<SkinListener* const> sinks,
                          const SkinRunOptions& options) {
    for (auto* l : sinks)
        if (auto ok = l->begin(input); !ok) return ok.error();
    std::vector<Spike> spikes;
    std::int64_t samples = 0;
    FlushTimer flush_timer;
    for (;;) {
        auto block = force.next();
        if (!block) return block.error();
        const std::size_t steps = block->total.size();
        if (steps == 0) break;
        if (options.spool)
            if (auto ok = options.spool->force(*block, samples); !ok) return ok.error();
        if (auto ok = run_block(*block, samples, skin, options.spool, spikes); !ok) return ok.error();
        for (auto* l : sinks)
            if (auto ok = l->block(input, {samples, steps, block->force, block->total, spikes}); !ok) return ok.error();
        samples += static_cast<std::int64_t>(steps);
        const bool stop = !options.keep_on(force.done());
        if (options.spool && samples > options.spool->step() && (stop || flush_timer.is_due()))
            if (auto ok = options.spool->keep(); !ok) return ok.error();
        if (stop) return Error{ErrorCode::interrupted, "interrupted"};
    }
    if (samples == 0) return bad_input("no samples of force", {input.name});
    if (options.spool)
        if (auto ok = options.spool->ended(samples); !ok) return ok.error();
    spikes.clear();
    if (auto ok = skin.last(spikes); !ok) return ok.error();
    for (auto* l : sinks)
        if (auto ok = l->end(input, samples, spikes); !ok) return ok.error();
    return skin.work();
}

}  // namespace corpuscle
