// .tran: the circuit in time.

#include <fmt/format.h>

#include "circuit/analyses.hpp"
#include "circuit/analysis/transient_plan.hpp"
#include "circuit/force_order.hpp"
#include "circuit/spike_output.hpp"

namespace corpuscle::circuit {
namespace {

/// Spikes as numbers to print and to expect.
void tell(const std::vector<double>& spikes, Findings& out) {
    out.numbers.emplace_back("spikes", static_cast<double>(spikes.size()));
    if (spikes.empty()) return;
    out.numbers.emplace_back("first_spike", spikes.front());
    out.numbers.emplace_back("last_spike", spikes.back());
    if (spikes.size() > 1)
        out.numbers.emplace_back("mean_interval", (spikes.back() - spikes.front()) / static_cast<double>(spikes.size() - 1));
}

}  // namespace

Result<Findings> analyse_tran(TestBench& bench, const Command& c) {
    const auto times = transient_times(c);
    if (!times) return times.error();
    auto asked = transient_plan(*bench.circuit);
    if (!asked) return asked.error();
    const auto output = spike_output(bench.system);
    if (!output) return output.error();
    const auto force = force_order(*bench.circuit);
    if (!force) return force.error();
    if (*force && !bench.system.hear(&**force))
        return bad_input(".force: no source carries it; one is written 'iin 0 fin force 60n' (60 nA a newton)", Place{bench.circuit->file});
    TransientPlan& plan = *asked;
    plan.stop = times->stop, plan.longest = times->longest.value_or((times->stop - times->start) / 50);
    bench.system.go(times->step, times->stop);
    Findings out;
    Plot plot = plot_of(bench.system, "Transient Analysis", "time", "time");
    Transient transient(bench.system, bench.newton, plan);
    std::vector<double> spikes;
    bool stopped = false;
    const auto x = beginning(bench, times->uic);
    auto done = !x ? Result<void>(x.error()) : transient.run(*x, [&](double t, std::span<const double> at) {
        if (t >= times->start) append(plot, t, at);
        if (*output)
            if (const auto spike = (*output)->within(transient); spike && *spike >= times->start) spikes.push_back(*spike);
        stopped = bench.stopped(t / times->stop);
        return !stopped;
    });
    bench.system.go(0, 0), bench.system.hear(nullptr);
    if (!done) return done.error();
    if (stopped) return interruption();
    const auto& work = transient.work();
    out.table = fmt::format("{} steps, {} rejected, {} Newton iterations\n", work.steps, work.rejected, work.iterations);
    out.plots.push_back(std::move(plot));
    if (*output) tell(spikes, out), out.spikes = std::move(spikes);
    return out;
}

}  // namespace corpuscle::circuit
