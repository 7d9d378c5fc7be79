// .tran: the circuit in time.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "circuit/analyses.hpp"
#include "circuit/analysis/beginning.hpp"
#include "circuit/analysis/transient_plan.hpp"
#include "circuit/device/values.hpp"
#include "circuit/force_order.hpp"
#include "circuit/spike_output.hpp"
#include "circuit/within.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

struct Asked {
    TransientTimes times;
    TransientPlan plan;
    std::optional<SpikeOutput> output;
    Beginning from;
};

/// How long each of the circuit's ranges was left, step by step.
class Watch {
    struct One {
        Within range;
        double outside = 0, first = -1;  // s
        bool is_out = false;
    };
    std::vector<One> all_;
    double before_ = 0;

public:
    explicit Watch(std::vector<Within> ranges) {
        for (auto& r : ranges) all_.push_back({std::move(r)});
    }
    void look(double t, std::span<const double> x) {
        for (auto& one : all_) {
            const bool was_out = std::exchange(one.is_out, !one.range.holds(one.range.what.of.of(x)));
            one.outside += (t - before_) * (was_out + one.is_out) / 2;  // it crossed somewhere within the step
            if (one.is_out && one.first < 0) one.first = t;
        }
        before_ = t;
    }
    void tell(std::vector<Error>& remarks) const {
        for (const auto& one : all_)
            if (one.first >= 0)
                remarks.push_back(bad_input(outside_sentence(one.range.range(), one.outside, before_, one.first), one.range.place));
    }
};

/// LONGEST, or STEP between a two hundredth and a fiftieth of the whole: what comes and goes within a step is not seen.
double longest_of(const TransientTimes& t) {
    const double whole = t.stop - t.start;
    return t.longest.value_or(std::clamp(t.step, whole / 200, whole / 50));
}

/// The spikes of a transient, whose points go to each().
Result<std::vector<double>> spikes_of(TestBench& bench, const Asked& asked, Transient& t, const Transient::Each& each) {
    std::vector<double> out;
    bool stopped = false;
    const auto done = t.run(
        asked.from.x, asked.from.settled,
        [&](double time, std::span<const double> x) {
            if (!each(time, x)) return false;
            if (time < t.time()) return true;  // within a step
            if (asked.output)
                if (const auto spike = asked.output->within(t); spike && *spike >= asked.times.start) out.push_back(*spike);
            bench.capped = bench.most_iterations > 0 && t.work().iterations > bench.most_iterations;
            return !bench.capped && !(stopped = bench.stopped(time / asked.times.stop));
        },
        asked.from.charge);
    if (!done) return done.error();
    if (stopped) return interruption();
    if (bench.capped)
        return Error{Code::not_converged,
                     fmt::format("stopped at {} after {} iterations", format_quantity(t.time(), "s"), t.work().iterations)};
    return out;
}

/// How far off a spike may be, s: what another run with a tenth of the tolerances says, whose own errors are a third of these at the most.
/// NaN: it has other spikes.
Result<double> spike_error(TestBench& bench, Asked asked, const std::vector<double>& spikes) {
    for (double* tolerance : {&asked.plan.reltol, &asked.plan.vntol, &asked.plan.abstol}) *tolerance /= 10;
    // Only the spikes are compared: neither other curves nor points within a step are needed.
    asked.plan.all_reported = false, asked.plan.steps_only = true;
    asked.plan.reported = {asked.output->of.plus, asked.output->of.minus};
    Transient transient(bench.system, bench.newton, asked.plan);
    const auto finer = spikes_of(bench, asked, transient, [](double, std::span<const double>) { return true; });
    if (!finer && finer.error().code == Code::interrupted) return finer.error();
    if (!finer || finer->size() != spikes.size()) return std::nan("");
    double most = 0;
    for (std::size_t k = 0; k < spikes.size(); ++k) most = std::max(most, std::abs((*finer)[k] - spikes[k]));
    return 1.5 * most;
}

/// Spikes as numbers to print and to expect.
Result<void> tell(TestBench& bench, const Asked& asked, std::vector<double> spikes, Findings& out) {
    out.numbers.emplace_back("spikes", static_cast<double>(spikes.size()));
    if (!spikes.empty()) {
        out.numbers.emplace_back("first_spike", spikes.front());
        out.numbers.emplace_back("last_spike", spikes.back());
        if (spikes.size() > 1)
            out.numbers.emplace_back("mean_interval", (spikes.back() - spikes.front()) / static_cast<double>(spikes.size() - 1));
        if (!bench.brief && value_or(bench.circuit->options, "spikecheck", 1) != 0) {
            const auto error = spike_error(bench, asked, spikes);
            if (!error) return error.error();
            out.numbers.emplace_back("spike_error", *error);
            if (std::isnan(*error))
                out.remarks.push_back(
                    bad_input(fmt::format("{} spikes, but others with a tenth of the tolerances; .options accuracy=fine is safer here",
                                          spikes.size()),
                              asked.output->place));
        }
    }
    out.spikes = std::move(spikes);
    return {};
}

}  // namespace

Result<Findings> analyse_tran(TestBench& bench, const Command& c) {
    const auto times = transient_times(c);
    if (!times) return times.error();
    const auto plan = transient_plan(*bench.circuit);
    if (!plan) return plan.error();
    const auto output = spike_output(bench.system);
    if (!output) return output.error();
    auto ranges = within_of(bench.system);
    if (!ranges) return ranges.error();
    Watch watch(std::move(*ranges));
    bench.capped = false;
    const auto force = force_order(*bench.circuit);
    if (!force) return force.error();
    if (*force && !bench.system.hear(&**force))
        return bad_input(fmt::format(".force: no source carries it; one is written '{}' (60 nA a newton)", "iin 0 fin force 60n"),
                         Place{bench.circuit->file});
    Asked asked{*times, *plan, *output, {}};
    asked.plan.all_reported = true;
    asked.plan.stop = times->stop, asked.plan.longest = longest_of(*times);
    KeptPlot kept;
    PointSink& points = bench.points ? *bench.points : kept;
    if (auto ok = points.begin(plot_of(bench.system, "Transient Analysis", "time", "time")); !ok) return ok.error();

    bench.system.go(times->step, times->stop);
    Findings out;
    Transient transient(bench.system, bench.newton, asked.plan);
    Result<void> taken;
    std::vector<double> row(1);
    auto from = beginning(bench, times->uic);
    if (from) asked.from = std::move(*from);
    if (asked.from.remark && !bench.brief) out.remarks.push_back(*asked.from.remark);
    auto spikes = !from ? from.error() : spikes_of(bench, asked, transient, [&](double t, std::span<const double> x) {
        watch.look(t, x);
        if (t < times->start) return true;
        row.assign(1, t), row.insert(row.end(), x.begin(), x.end());
        taken = points.point(row);
        return static_cast<bool>(taken);
    });
    const auto ended = points.end();
    const auto told = spikes && taken && ended && asked.output ? tell(bench, asked, std::move(*spikes), out) : Result<void>();
    bench.system.go(0, 0), bench.system.hear(nullptr);
    if (!spikes) return spikes.error();
    for (const auto& done : {taken, ended, told})
        if (!done) return done.error();
    if (!bench.brief) watch.tell(out.remarks);
    const auto& work = transient.work();
    out.table = fmt::format("{} steps, {} rejected, {} Newton iterations\n", work.steps, work.rejected, work.iterations);
    out.work = {{"steps", static_cast<double>(work.steps)},
                {"rejected", static_cast<double>(work.rejected)},
                {"iterations", static_cast<double>(work.iterations)}};
    if (!bench.points) out.plots.push_back(std::move(kept.plot));
    return out;
}

}  // namespace corpuscle::circuit
