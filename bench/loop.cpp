// How long does the circuit of an afferent with 108 transistor arrays ("the loop", from a force's current to spikes) take for one second of
// touch, and how is the time of a Newton iteration divided?
//
//     bench-loop [NETLIST] [ROUNDS]      default: bench/decks/loop.cir, 5 rounds
//
// Method: one core, processor seconds, default accuracy (`.options accuracy=normal`). The netlist starts from its
// operating point with .ic held. It runs one second as it is, and one second with a constant input current of 60 nA, at which there are no
// spikes; the difference is the cost of spikes. The operating-point search is not counted. Then the parts of an iteration are timed
// separately at about 256 points of the run. The first part is the evaluation of the transistors, with their charges, on lanes. The others
// are factoring and solving each matrix (conductances, plus capacitances over a step of 10 us), both along the elimination list and by KLU
// with its last pivots. The rest of an iteration is bookkeeping: moving voltages to the lanes and derivatives to the matrix, prediction,
// errors, history, convergence, crossings. Each line has median, minimum and maximum of the rounds.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>

#include "circuit/analysis/transient_setup.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::circuit;

constexpr double seconds = 1;            // simulated
constexpr double level = 0.35;           // V: a spike is an upward crossing by v(s)
constexpr double quiet_current = 60e-9;  // A
constexpr double step = 10e-6;           // s
constexpr std::size_t max_points = 256;  // approximately

/// Processor time, s; other load on the machine affects it less than wall time.
double processor_time() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Median, minimum and maximum. `scale`: converts s to `unit`.
void print_times(const char* label, std::vector<double> times, double scale, const char* unit) {
    std::sort(times.begin(), times.end());
    std::printf("  %-34s %9.3f %s (%.3f ... %.3f)\n", label, times[times.size() / 2] * scale, unit, times.front() * scale,
                times.back() * scale);
}
double median(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + static_cast<long>(times.size() / 2), times.end());
    return times[times.size() / 2];
}

struct OneSecondRun {
    std::vector<double> times;  // processor time of each round, s
    TransientStats work;        // of the last round; so are the following
    double reltol = 0;
    std::vector<double> spikes;               // s
    std::vector<std::vector<double>> points;  // unknowns at some of the steps
    std::vector<double> point_times;          // s
};

/// Runs one second `rounds` times from the same start. `quiet`: with the constant input current.
Result<OneSecondRun> run_one_second(AnalysisContext& bench, int rounds, bool quiet) {
    OneSecondRun out;
    const int spiking = bench.system.unknown("v(s)");
    TransientPlan plan;
    plan.stop = seconds, plan.max_step = seconds / 50;
    out.reltol = plan.reltol;
    for (int round = 0; round < rounds; ++round) {
        bench.system.start_transient(1e-3, seconds);
        // A transient of length 0 removes the waveform, so that the source has its DC value.
        if (auto* force = bench.system.device("if"); quiet && force != nullptr)
            force->start_transient(0, 0), force->set_principal_value(quiet_current);
        const auto from = find_initial_condition(bench, false);
        if (!from) return from.error();
        out.spikes.clear(), out.points.clear(), out.point_times.clear();
        Transient transient(bench.system, bench.newton, plan);
        // The number of steps is known after the first round.
        const long spacing = std::max(1L, out.work.steps / static_cast<long>(max_points));
        const double start = processor_time();
        if (auto ok = transient.begin(from->x, from->is_consistent); !ok) return ok.error();
        while (transient.time() < seconds) {
            if (const auto ok = transient.step(seconds); !ok) return ok.error();
            if (const auto at = transient.crossing(spiking, -1, level, true)) out.spikes.push_back(*at);
            if (round > 0 && transient.stats().steps % spacing == 0) {
                out.points.emplace_back(transient.x().begin(), transient.x().end());
                out.point_times.push_back(transient.time());
            }
        }
        out.times.push_back(processor_time() - start);
        bench.newton.context.with_charges = false;
        bench.system.start_transient(0, 0);
        out.work = transient.stats();
    }
    return out;
}

/// For each round of `count` calls: the mean processor time of one call, s.
std::vector<double> time_each(int rounds, std::size_t count, const std::function<void(std::size_t)>& one) {
    std::vector<double> out;
    for (int round = 0; round < rounds; ++round) {
        const double start = processor_time();
        for (std::size_t k = 0; k < count; ++k) one(k);
        out.push_back((processor_time() - start) / static_cast<double>(count));
    }
    return out;
}

/// Processor times (s) of the parts of an iteration, one for each round. factor, solve: by KLU; factor_listed, solve_listed: along the
/// list.
struct IterationParts {
    std::vector<double> devices, factor, solve, factor_listed, solve_listed;
    long off_list = 0;  // matrices that could not be eliminated along the list
};

IterationParts time_parts(const AnalysisContext& bench, const OneSecondRun& run, int rounds) {
    IterationParts out;
    EvalContext context;
    context.gmin = bench.tolerances.gmin;
    auto memory = bench.system.initial_limiting_state();
    SystemEvaluation sums;
    const auto count = run.points.size(), entries = bench.system.pattern().entries();
    const DeviceGroup& transistors = bench.system.groups()[0];
    const auto n = transistors.terminals, stride = transistors.stride;
    struct alignas(64) CacheLine {
        double values[8];
    };
    std::vector<CacheLine> lines((3 * n + 2 * n * n) * stride / 8);
    // voltages, currents, charges, then the derivatives of the currents and of the charges
    double *const v = lines[0].values, *const f = v + n * stride, *const q = f + n * stride, *const df = q + n * stride;
    out.devices = time_each(rounds, count, [&](std::size_t k) {
        for (std::size_t m = 0; m < transistors.members.size(); ++m)
            for (std::size_t j = 0; j < n; ++j) {
                const int u = transistors.unknowns[m * n + j];
                v[j * stride + m] = u < 0 ? 0 : run.points[k][static_cast<std::size_t>(u)];
            }
        constexpr double rate = 1e5;  // 1/s; one over `step`
        transistors.batch->eval(context, {stride, v, f, df, nullptr, q, df + n * n * stride, rate});
    });
    std::vector<std::vector<double>> matrices;
    for (std::size_t k = 0; k < count; ++k) {
        context.time = run.point_times[k];
        bench.system.eval(run.points[k], context, memory, sums);
        matrices.emplace_back(entries);
        for (std::size_t e = 0; e < entries; ++e) matrices.back()[e] = sums.G[e] + sums.C[e] / step;
    }
    LinearSolver<double> solver(bench.system.pattern());
    std::vector<double> b(static_cast<std::size_t>(bench.system.size()), 1e-9);
    const auto factors = [&](std::size_t k) { (void)solver.factor(matrices[k]); };
    const auto solves = [&](std::size_t) { solver.solve(b), b.assign(b.size(), 1e-9); };
    out.factor = time_each(rounds, count, factors), out.solve = time_each(rounds, count, solves);
    solver.fix_pivot_order(matrices[count / 2]);
    out.factor_listed = time_each(rounds, count, factors), out.solve_listed = time_each(rounds, count, solves);
    out.off_list = solver.fallback_count() / rounds;
    return out;
}

void report(const AnalysisContext& bench, const OneSecondRun& whole, const OneSecondRun& quiet, const IterationParts& parts) {
    const auto row = [](const char* label, const OneSecondRun& s) {
        std::printf("%s, with an allowed relative error of %g: %ld steps, %ld rejected, %ld Newton iterations, %zu spikes", label, s.reltol,
                    s.work.steps, s.work.rejected, s.work.iterations, s.spikes.size());
        if (!s.spikes.empty()) std::printf(", from %.6f to %.6f s", s.spikes.front(), s.spikes.back());
        std::printf("\n");
        print_times("complete", s.times, 1, "s");
        print_times("an iteration", s.times, 1e6 / static_cast<double>(s.work.iterations), "us");
    };
    row("a second of touch", whole);
    const double spikes = static_cast<double>(whole.spikes.size()), extra_spikes = spikes - static_cast<double>(quiet.spikes.size());
    if (spikes > 0) print_times("per spike, in total", whole.times, 1e3 / spikes, "ms");
    row("a quiet second", quiet);
    if (extra_spikes > 0)
        std::printf("  a spike, by the difference %18.3f ms\n", (median(whole.times) - median(quiet.times)) * 1e3 / extra_spikes);
    std::printf("an iteration: %d unknowns, %zu devices, %zu entries\n", bench.system.size(), bench.system.devices().size(),
                bench.system.pattern().entries());
    print_times("transistors", parts.devices, 1e6, "us");
    print_times("elimination, KLU: factor", parts.factor, 1e6, "us");
    print_times("elimination, KLU: solve", parts.solve, 1e6, "us");
    print_times("elimination, listed: factor", parts.factor_listed, 1e6, "us");
    print_times("elimination, listed: solve", parts.solve_listed, 1e6, "us");
    std::printf("  %ld of %zu matrices were not eliminated along the list\n", parts.off_list, whole.points.size());
    const double all = median(whole.times) * 1e6 / static_cast<double>(whole.work.iterations), devices = median(parts.devices) * 1e6;
    const double elimination = (median(parts.factor_listed) + median(parts.solve_listed)) * 1e6;
    std::printf("  devices %.0f %%, elimination %.0f %%, bookkeeping %.0f %% of %.2f us\n", 100 * devices / all, 100 * elimination / all,
                100 * (1 - (devices + elimination) / all), all);
}

int fail(const Error& error) { return std::fprintf(stderr, "%s\n", error.text().c_str()), 1; }

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 2 ? std::max(2, std::atoi(argv[2])) : 5;
    const auto netlist = Netlist::read(argc > 1 ? argv[1] : "bench/decks/loop.cir");
    if (!netlist) return fail(netlist.error());
    auto circuit = netlist->elaborate();
    if (!circuit) return fail(circuit.error());
    auto bench = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
    if (!bench) return fail(bench.error());
    if ((*bench)->system.unknown("v(s)") < 0) return std::fputs("bench-loop: the netlist has no node s\n", stderr), 1;
    const auto whole = run_one_second(**bench, rounds, false);
    if (!whole) return fail(whole.error());
    const auto quiet = run_one_second(**bench, rounds, true);
    if (!quiet) return fail(quiet.error());
    report(**bench, *whole, *quiet, time_parts(**bench, *whole, 20 * rounds));
}
