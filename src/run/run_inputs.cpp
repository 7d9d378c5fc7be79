#include "run/run_inputs.hpp"

#include <algorithm>

namespace corpuscle {
namespace {

Result<void> run_input(BlockSimulator& simulator, std::span<Sink* const> sinks, const RespondOptions& options, ThreadPool& pool,
                       RunStats& stats) {
    const bool wants_probes = std::any_of(sinks.begin(), sinks.end(), [](const Sink* sink) { return sink->wants_probes(); });
    TRY(simulator.start(options, wants_probes));
    const Input& input = simulator.input();
    for (auto* sink : sinks) TRY(sink->begin(input));
    std::int64_t samples = 0;
    for (;;) {
        const auto block = TRY(simulator.next(pool, stats));
        if (block.steps == 0) break;
        for (auto* sink : sinks) TRY(sink->block(input, block));
        samples = block.end_sample();
        const bool stops = !options.should_continue(completed_fraction(input, simulator.progress()));
        TRY(simulator.save(stops));
        if (stops) return interrupted_error();
    }
    if (samples == 0) return bad_input("no samples of force", {input.name});
    std::vector<Spike> last;
    TRY(simulator.finish(last, stats));
    for (auto* sink : sinks) TRY(sink->end(input, samples, last));
    return {};
}

}  // namespace

Input make_input(const Population& population, std::string name, const ForceSource& source) {
    return {{std::move(name), source.description(), source.clock(), source.phases(), source.cycle_frequency(), source.metadata(),
             source.notes(), source.is_recording()},
            population};
}

Result<RunStats> run(std::vector<std::unique_ptr<BlockSimulator>> inputs, std::span<Sink* const> sinks, const RespondOptions& options) {
    ThreadPool single_thread(1);
    RunStats stats;
    for (auto& simulator : inputs) {
        TRY(run_input(*simulator, sinks, options, options.pool ? *options.pool : single_thread, stats));
        simulator.reset();
    }
    return stats;
}

Result<RunStats> run(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> plans,
                     std::span<Sink* const> sinks, const RespondOptions& options) {
    return run(make_channel_simulators(sources, plans), sinks, options);
}

}  // namespace corpuscle
