// .tran: transient analysis.

#include "circuit/afferent/force_waveform.hpp"
#include "circuit/analysis/transient_setup.hpp"
#include "circuit/device/named_values.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// The input of a transient: .tran, .options, .spike, initial condition.
struct TranSetup {
    TransientTimes times;
    TransientPlan plan;
    std::optional<SpikeOutput> spike_output;
    InitialCondition initial;
};

/// Measures how long the quantity of each .assert is outside its operating range.
class RangeMonitor {
    struct MonitoredRange {
        OperatingRange range;
        double outside = 0;       // s: total time outside the range
        double first = -1;        // s: time of the first point outside; -1: none
        bool is_outside = false;  // at the last point
    };
    std::vector<MonitoredRange> ranges_;
    double last_time_ = 0;  // s: time of the last point

public:
    explicit RangeMonitor(std::vector<OperatingRange> ranges) {
        for (auto& range : ranges) ranges_.push_back({std::move(range)});
    }
    void add_point(double t, std::span<const double> x) {
        for (auto& r : ranges_) {
            const bool was_outside = std::exchange(r.is_outside, !r.range.contains(r.range.quantity.unknowns.value(x)));
            // A step counts with half of its length if only one of its ends is outside.
            r.outside += (t - last_time_) * (was_outside + r.is_outside) / 2;
            if (r.is_outside && r.first < 0) r.first = t;
        }
        last_time_ = t;
    }
    /// Adds a warning for each range that was violated.
    void report(std::vector<Error>& warnings) const {
        for (const auto& r : ranges_)
            if (r.first >= 0)
                warnings.push_back(bad_input(range_violation_message(r.range.range(), r.outside, last_time_, r.first), r.range.location));
    }
};

/// The maximum step: LONGEST if given, otherwise STEP, but at least 1/200 of the duration and, so that short events are not missed, at
/// most 1/50 of it.
double max_step_of(const TransientTimes& t) {
    const double duration = t.stop - t.start;
    return t.max_step.value_or(std::clamp(t.step, duration / 200, duration / 50));
}

/// Runs a transient, passes its points to each(), and returns the times (s) of its spikes from START on.
Result<std::vector<double>> run_transient(AnalysisContext& context, const TranSetup& setup, Transient& t,
                                          const Transient::PointCallback& each) {
    std::vector<double> out;
    bool stopped = false;
    context.system.set_states(setup.initial.states);
    const auto done = t.run(
        setup.initial.x, setup.initial.is_consistent,
        [&](double time, std::span<const double> x) {
            if (!each(time, x)) return false;
            if (time < t.time()) return true;  // within a step
            if (setup.spike_output)
                if (const auto spike = setup.spike_output->find_spike(t); spike && *spike >= setup.times.start) out.push_back(*spike);
            context.hit_iteration_limit = context.max_iterations > 0 && t.stats().iterations > context.max_iterations;
            return !context.hit_iteration_limit && !(stopped = context.is_stopped(time / setup.times.stop));
        },
        setup.initial.charge);
    if (stopped || context.newton.is_stopped()) return interrupted_error();
    if (!done) return done.error();
    if (context.hit_iteration_limit)
        return Error{ErrorCode::not_converged,
                     fmt::format("stopped at {} after {} iterations", format_quantity(t.time(), "s"), t.stats().iterations)};
    return out;
}

/// Estimates the largest error of a spike time (s) by a second transient with a tenth of the tolerances. Its errors are assumed to be at
/// most a third of those of the first. Returns NaN if it has a different number of spikes, or fails.
Result<double> spike_error(AnalysisContext& context, TranSetup setup, const std::vector<double>& spikes) {
    for (double* tolerance : {&setup.plan.reltol, &setup.plan.vntol, &setup.plan.abstol}) *tolerance /= 10;
    // Only the spikes are compared, so other unknowns and points within a step are not needed.
    setup.plan.all_reported = false, setup.plan.steps_only = true;
    setup.plan.reported = {setup.spike_output->quantity.unknowns.plus, setup.spike_output->quantity.unknowns.minus};
    Transient transient(context.system, context.newton, setup.plan);
    const auto finer = run_transient(context, setup, transient, [](double, std::span<const double>) { return true; });
    if (!finer && finer.error().code == ErrorCode::interrupted) return finer.error();
    if (!finer || finer->size() != spikes.size()) return std::nan("");
    double largest = 0;
    for (std::size_t k = 0; k < spikes.size(); ++k) largest = std::max(largest, std::abs((*finer)[k] - spikes[k]));
    return 1.5 * largest;  // the difference is at least two thirds of the error of the first
}

/// Adds the spikes to the printed numbers, which .expect can check.
Result<void> report_spikes(AnalysisContext& context, const TranSetup& setup, std::vector<double> spikes, AnalysisResult& out) {
    out.numbers.emplace_back("spikes", static_cast<double>(spikes.size()));
    if (!spikes.empty()) {
        out.numbers.emplace_back("first_spike", spikes.front());
        out.numbers.emplace_back("last_spike", spikes.back());
        if (spikes.size() > 1)
            out.numbers.emplace_back("mean_interval", (spikes.back() - spikes.front()) / static_cast<double>(spikes.size() - 1));
        if (!context.is_brief && value_or(context.circuit->options, "spikecheck", 1) != 0) {
            const auto error = TRY(spike_error(context, setup, spikes));
            out.numbers.emplace_back("spike_error", error);
            if (std::isnan(error))
                out.warnings.push_back(error_at(
                    setup.spike_output->location,
                    "{} spikes, but a different number with a tenth of the tolerances; use .options accuracy=fine", spikes.size()));
        }
    }
    out.spikes = std::move(spikes);
    return {};
}

/// Gives the sources their waveforms and the force; its destructor sets them back to their DC values.
class TransientSources {
    System& system_;

public:
    explicit TransientSources(System& system) : system_(system) {}
    TransientSources(const TransientSources&) = delete;
    ~TransientSources() { system_.start_transient(0, 0), system_.set_force_input(nullptr); }
    void start(const TransientTimes& times) { system_.start_transient(times.step, times.stop); }
    /// Returns false if no source has a force input. The force must outlive this object.
    bool set_force(const ForceWaveform& force) { return system_.set_force_input(&force); }
};

Result<AnalysisResult> analyse_tran(AnalysisContext& context, const Directive& c) {
    const auto times = TRY(read_transient_times(c));
    const auto plan = TRY(read_transient_plan(*context.circuit));
    const auto spike_output = TRY(read_spike_output(context.system));
    RangeMonitor range_monitor(TRY(read_operating_ranges(context.system)));
    context.hit_iteration_limit = false;
    const auto force = TRY(force_directive(*context.circuit));
    TransientSources sources(context.system);
    if (force && !sources.set_force(*force))
        return error_at({context.circuit->file}, ".force: no source has a force input; add one such as '{}' (60 nA/N)",
                        "iin 0 fin force 60n");
    TranSetup setup{times, plan, spike_output, {}};
    setup.plan.all_reported = true;
    setup.plan.noise.stream = noise_stream_of(context.chip_sample());
    setup.plan.stop = times.stop, setup.plan.max_step = max_step_of(times);
    PlotRecorder recorder;
    PointSink& points = context.points ? *context.points : recorder;
    TRY(points.begin(make_plot(context.system, "Transient Analysis", "time", "time")));

    sources.start(times);
    AnalysisResult out;
    Transient transient(context.system, context.newton, setup.plan);
    Result<void> written;
    std::vector<double> row(1);
    auto initial = find_initial_condition(context, times.uic);
    if (initial) setup.initial = std::move(*initial);
    if (setup.initial.warning && !context.is_brief) out.warnings.push_back(*setup.initial.warning);
    auto spikes = !initial ? initial.error() : run_transient(context, setup, transient, [&](double t, std::span<const double> x) {
        range_monitor.add_point(t, x);
        if (t < times.start) return true;
        row.assign(1, t), row.insert(row.end(), x.begin(), x.end());
        written = points.add_point(PlotRow(row));
        return static_cast<bool>(written);
    });
    const auto ended = points.end();
    const auto reported =
        spikes && written && ended && setup.spike_output ? report_spikes(context, setup, std::move(*spikes), out) : Result<void>();
    if (!spikes) return spikes.error();
    for (const auto& done : {written, ended, reported})
        if (!done) return done.error();
    if (!context.is_brief) range_monitor.report(out.warnings);
    const auto& work = transient.stats();
    out.table = fmt::format("{} steps, {} rejected, {} Newton iterations\n", work.steps, work.rejected, work.iterations);
    out.stats = {{"steps", static_cast<double>(work.steps)},
                 {"rejected", static_cast<double>(work.rejected)},
                 {"iterations", static_cast<double>(work.iterations)}};
    if (!context.points) out.plots.push_back(std::move(recorder.plot));
    return out;
}

Plot expected_tran_plot(const System& system, const Directive&) { return make_plot(system, "Transient Analysis", "time", "time"); }

constexpr std::string_view tran_numbers[] = {"spikes", "first_spike", "last_spike", "mean_interval", "spike_error"};

}  // namespace

extern constexpr Analysis tran_analysis = {.name = "tran",
                                           .usage = ".tran STEP STOP [START [LONGEST]] [uic]",
                                           .description = "the circuit over time, with automatic step size",
                                           .run = analyse_tran,
                                           .expected_plot = expected_tran_plot,
                                           .numbers = tran_numbers,
                                           .ngspice_order = 4};

}  // namespace corpuscle::circuit
