// .tran: the circuit in time.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analyses.hpp"
#include "circuit/analysis/beginning.hpp"
#include "circuit/analysis/transient_plan.hpp"
#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

struct Times {
    double step, stop, start = 0, longest;
    bool uic = false;
};

Result<Times> times_of(const Command& given) {
    auto c = given;
    Times out{};
    out.uic = !c.words.empty() && c.words.back() == "uic";
    if (out.uic) c.words.pop_back();
    if (c.words.size() < 2 || c.words.size() > 4) return bad_input(".tran: it is .tran STEP STOP [START [LONGEST]] [uic]", c.place);
    const auto step = number_of(c, 0, "a step"), stop = number_of(c, 1, "where it stops");
    const auto start = c.words.size() > 2 ? number_of(c, 2, "where it begins to be kept") : Result<double>(0.0);
    if (!step) return step.error();
    if (!stop) return stop.error();
    if (!start) return start.error();
    const auto longest = c.words.size() > 3 ? number_of(c, 3, "the longest step") : Result<double>((*stop - *start) / 50);
    if (!longest) return longest.error();
    if (!(*step > 0 && *stop > 0 && *start >= 0 && *start < *stop && *longest > 0))
        return bad_input(
            fmt::format(".tran: step {:g}, stop {:g}, start {:g}, longest {:g} s; all above 0, the start from 0 and below the stop", *step,
                        *stop, *start, *longest),
            c.place);
    out.step = *step, out.stop = *stop, out.start = *start, out.longest = *longest;
    return out;
}

}  // namespace

Result<Findings> analyse_tran(TestBench& bench, const Command& c) {
    const auto times = times_of(c);
    if (!times) return times.error();
    auto asked = transient_plan(*bench.circuit);
    if (!asked) return asked.error();
    TransientPlan& plan = *asked;
    plan.stop = times->stop, plan.longest = times->longest;
    KeptPlot kept;
    PointSink& points = bench.points ? *bench.points : kept;
    if (auto ok = points.begin(plot_of(bench.system, "Transient Analysis", "time", "time")); !ok) return ok.error();
    bench.system.go(times->step, times->stop);
    Findings out;
    Transient transient(bench.system, bench.newton, plan);
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
        stopped = bench.stopped(t / times->stop);
        return !stopped && taken;
    });
    const auto ended = points.end();
    bench.system.go(0, 0);
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
    return out;
}

}  // namespace corpuscle::circuit
