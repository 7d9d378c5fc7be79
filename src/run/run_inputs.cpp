#include "run/run_inputs.hpp"

#include <algorithm>

#include "run/channels/channel_simulator.hpp"

namespace corpuscle {
namespace {

/// The sinks, options, threads and totals that the inputs of a run share.
struct RunLoop {
    std::span<Sink* const> sinks;
    const RespondOptions& options;
    ThreadPool& pool;
    RunStats stats = {};

    /// Calls a function with each sink, until one returns an error.
    template <class F>
    Result<void> for_each_sink(const F& f) const {
        for (auto* sink : sinks) TRY(f(*sink));
        return {};
    }
    Result<void> run_input(BlockSimulator& simulator, bool wants_probes);
};

Result<void> RunLoop::run_input(BlockSimulator& simulator, bool wants_probes) {
    TRY(simulator.start(options, wants_probes));
    const Input& input = simulator.input();
    TRY(for_each_sink([&](Sink& sink) { return sink.begin(input); }));
    std::int64_t samples = 0;
    for (;;) {
        const auto block = TRY(simulator.next(pool, stats));
        if (block.steps == 0) break;
        TRY(for_each_sink([&](Sink& sink) { return sink.block(input, block); }));
        samples = block.end_sample();
        const double inputs_done = static_cast<double>(input.index) + simulator.progress();
        const bool stops = !options.should_continue(inputs_done / static_cast<double>(input.input_count));
        TRY(simulator.save(stops));
        if (stops) return Error{ErrorCode::interrupted, "interrupted"};
    }
    if (samples == 0) return bad_input("no samples of force", {input.name});
    std::vector<Spike> last;
    TRY(simulator.finish(last, stats));
    return for_each_sink([&](Sink& sink) { return sink.end(input, samples, last); });
}

}  // namespace

Input make_input(const Population& population, std::string name, const ForceSource& source) {
    return {population,      std::move(name),          source.description(), source.clock(),
            source.phases(), source.cycle_frequency(), source.metadata(),    source.notes()};
}

Result<RunStats> run(std::vector<std::unique_ptr<BlockSimulator>> inputs, std::span<Sink* const> sinks, const RespondOptions& options) {
    const bool wants_probes = std::any_of(sinks.begin(), sinks.end(), [](const Sink* sink) { return sink->wants_probes(); });
    ThreadPool single_thread(1);
    RunLoop loop{sinks, options, options.pool ? *options.pool : single_thread};
    for (auto& simulator : inputs) {
        TRY(loop.run_input(*simulator, wants_probes));
        simulator.reset();
    }
    return std::move(loop.stats);
}

Result<RunStats> run(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> plans,
                     std::span<Sink* const> sinks, const RespondOptions& options) {
    return run(make_channel_simulators(sources, plans), sinks, options);
}

}  // namespace corpuscle
