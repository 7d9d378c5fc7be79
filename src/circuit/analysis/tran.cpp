// .tran: the circuit in time.

#include <fmt/format.h>

#include "circuit/analyses.hpp"
#include "circuit/analysis/beginning.hpp"
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
    KeptPlot kept;
    PointSink& points = bench.points ? *bench.points : kept;
    if (auto ok = points.begin(plot_of(bench.system, "Transient Analysis", "time", "time")); !ok) return ok.error();
    bench.system.go(times->step, times->stop);
    Findings out;
    Transient transient(bench.system, bench.newton, plan);
    std::vector<double> spikes;
    bool stopped = false;
    Result<void> taken;
    std::vector<double> row(1);
    auto from = beginning(bench, times->uic);
    if (from && from->remark && !bench.brief) out.remarks.push_back(*from->remark);
    auto done = !from ? Result<void>(from.error()) : transient.run(from->x, from->settled, [&](double t, std::span<const double> at) {
        if (t >= times->start) {
            row.assign(1, t), row.insert(row.end(), at.begin(), at.end());
            taken = points.point(row);
        }
        if (t < transient.time()) return static_cast<bool>(taken);  // within a step
        if (*output)
            if (const auto spike = (*output)->within(transient); spike && *spike >= times->start) spikes.push_back(*spike);
        stopped = bench.stopped(t / times->stop);
        return !stopped && taken;
    });
    const auto ended = points.end();
    bench.system.go(0, 0), bench.system.hear(nullptr);
    if (!done) return done.error();
    if (!taken) return taken.error();
    if (!ended) return ended.error();
    if (stopped) return interruption();
    const auto& work = transient.work();
    out.table = fmt::format("{} steps, {} rejected, {} Newton iterations\n", work.steps, work.rejected, work.iterations);
    out.work = {{"steps", static_cast<double>(work.steps)},
                {"rejected", static_cast<double>(work.rejected)},
                {"iterations", static_cast<double>(work.iterations)}};
    if (!bench.points) out.plots.push_back(std::move(kept.plot));
    if (*output) tell(spikes, out), out.spikes = std::move(spikes);
    return out;
}

}  // namespace corpuscle::circuit
