// How many samples per second does one afferent process on one core, without SIMD lanes?
//
// Method: one second of the press, or of a 30 Hz sine about 1 N, at 10 kHz in one block of 10,000 samples, repeated; each repetition starts
// with the last state of the one before. Spikes are stored in memory. The result is the median processor time of 9 runs. The counters are
// `steps`, samples per second, and `spikes/step`, spikes per sample. The press is at rest for half its length, but the sine keeps the
// afferent active.

#include <benchmark/benchmark.h>

#include "core/stimulus/stimuli.hpp"
#include "model/catalog.hpp"

namespace {

using namespace corpuscle;

std::vector<double> force_of(const std::string& stimulus) {
    Frames block(1, 10000);
    const auto source = make_stimulus(stimulus, 10e3, 0);
    if (!(*source)->read(block)) return {};
    return block.force[0];
}

void respond(benchmark::State& run, const std::string& name, const std::string& stimulus, Method method) {
    const auto afferent = make_afferent(*plan_afferent(name), {1e-4, method, method == Method::backward_euler});
    const auto force = force_of(stimulus);
    std::vector<Spike> spikes;
    spikes.reserve(4096);
    auto state = afferent->start();
    std::int64_t fired = 0;
    for (auto _ : run) {
        spikes.clear();
        ResponseBlock out{spikes};
        if (!afferent->respond(force, state, out)) return run.SkipWithError("refused");
        fired += static_cast<std::int64_t>(spikes.size());
        benchmark::DoNotOptimize(spikes.data());
    }
    const auto samples = run.iterations() * static_cast<std::int64_t>(force.size());
    run.counters["steps"] = benchmark::Counter(static_cast<double>(samples), benchmark::Counter::kIsRate);
    run.counters["spikes/step"] = static_cast<double>(fired) / static_cast<double>(samples);
}

const bool registered = [] {
    for (const auto* name : {"sa1", "fa1", "sa2", "fa2", "sa1-kim", "fa1-lee", "sa1b+izhikevich", "sa1b+adex"})
        for (const auto* stimulus : {"press", "sine"})
            for (const auto method : {Method::exact, Method::backward_euler})
                benchmark::RegisterBenchmark(
                    (std::string(name) + "/" + stimulus + (method == Method::exact ? "/exact" : "/backward-euler")).c_str(),
                    [=](benchmark::State& run) { respond(run, name, stimulus, method); })
                    ->MinTime(0.05)
                    ->Repetitions(9)
                    ->ReportAggregatesOnly();
    return true;
}();

}  // namespace
