#include "circuit/run_directives.hpp"

#include "circuit/analyses.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/measure/measurement_set.hpp"
#include "circuit/output/output_directives.hpp"

namespace corpuscle::circuit {
namespace {

/// Parses "v(out) 0.35 1%" or "v(out)=0.35 2m".
Result<Expectation> expectation_of(const Directive& c) {
    auto words = c.words;
    if (words.size() == 2 && words[0].find('=') != std::string::npos) {  // v(out)=0.35 1%
        const auto at = words[0].find('=');
        words.insert(words.begin() + 1, words[0].substr(at + 1));
        words[0].resize(at);
    }
    if (words.size() != 3) return error_at(c.location, ".expect: expected .expect NAME VALUE TOLERANCE, such as '.expect v(out) 0.35 1%'");
    const bool is_relative = words[2].ends_with('%');
    const auto value = parse_number(words[1]), tolerance = parse_number(is_relative ? words[2].substr(0, words[2].size() - 1) : words[2]);
    if (!value) return error_at(c.location, ".expect: '{}' is not a number", words[1]);
    if (!tolerance || !(tolerance->value >= 0))
        return error_at(c.location, ".expect: '{}' is not a tolerance; write one such as 1% or 2m", words[2]);
    return Expectation{words[0], value->value, is_relative ? std::abs(value->value) * tolerance->value / 100 : tolerance->value,
                       0,        false,        c.location};
}

Result<void> check_expectations(const Circuit& circuit, RunOutcome& out) {
    for (const auto& c : circuit.directives_named("expect")) {
        auto e = TRY(expectation_of(c));
        const auto found = out.find_number(e.name);
        if (!found)
            return error_at(c.location, ".expect: there is no measurement, number or curve '{}'{}", e.name,
                            did_you_mean(e.name, std::views::keys(out.numbers)));
        e.actual = *found, e.is_met = std::abs(*found - e.expected) <= e.tolerance;
        out.expectations.push_back(std::move(e));
    }
    return {};
}

/// Passes the points of the plots of one analysis to the measurements, to .print and to the sinks of the options, and stores them. Only the
/// first plot is measured and printed. If options.keep_points is false, a transient is not stored, since it takes memory in proportion to
/// the length of the run.
class PointDispatcher final : public PointSink {
    const RunOptions& options_;
    MeasurementSet& measures_;
    FourierTransforms* fourier_;  // null if the analysis is not a .tran
    AnalysisRun& run_;
    DeviceCurrents currents_;
    TablePrinter printer_;
    PlotRecorder recorder_;
    std::optional<CurveSelector> selector_;  // passes the saved curves on to the sink of the options
    std::vector<PointSink*> sinks_;          // of the present plot
    std::vector<double> last_values_;        // at the last point of the first plot

public:
    std::vector<Plot> plots;      ///< stored
    std::vector<Error> left_out;  ///< curves of .four
    std::size_t plot_count = 0;   ///< ended so far

    PointDispatcher(const Circuit& circuit, const RunOptions& options, const std::vector<std::string>& saved_curves,
                    MeasurementSet& measures, FourierTransforms* fourier, AnalysisRun& run, const DeviceCurrents& currents)
        : options_(options), measures_(measures), fourier_(fourier), run_(run), currents_(currents), printer_(circuit, *run.directive) {
        if (options.curve_sink) selector_.emplace(saved_curves, *options.curve_sink);
    }
    bool is_transient() const { return run_.directive->name == "tran"; }

    Result<void> begin(const Plot& unknowns) override {
        Plot head = unknowns;
        currents_.begin(head);
        sinks_.clear();
        if (is_transient() && options_.unknowns_sink) sinks_.push_back(options_.unknowns_sink);
        if (is_first() && options_.print_tables) sinks_.push_back(&printer_);
        if (keeps_points()) sinks_.push_back(&recorder_);
        if (selector_) sinks_.push_back(&*selector_);
        if (is_first()) run_.last_point = head, TRY(measures_.begin(*run_.directive, head));
        if (fourier_) TRY(fourier_->begin(*run_.directive, head, left_out));
        for (auto* sink : sinks_) TRY(sink->begin(head));
        return {};
    }
    Result<void> add_point(const PlotRow& unknowns) override {
        const auto row = currents_.extend(unknowns);
        if (is_first()) {
            ++run_.point_count;
            measures_.add_point(row);
            if (fourier_) fourier_->add_point(row);
            last_values_.assign(row.real.begin(), row.real.end());
        }
        for (auto* sink : sinks_) TRY(sink->add_point(row));
        return {};
    }
    Result<void> end() override {
        for (auto* sink : sinks_) TRY(sink->end());
        if (keeps_points()) plots.push_back(std::move(recorder_.plot));
        if (plot_count++ > 0) return {};
        for (std::size_t k = 0; k < last_values_.size(); ++k) run_.last_point.curves[k].values = {last_values_[k]};
        run_.printed_tables = printer_.text();
        return {};
    }

private:
    bool is_first() const { return plot_count == 0; }
    bool keeps_points() const { return options_.keep_points || !is_transient(); }
};

/// Runs one analysis, and passes on the points of its plots: those of a transient while it runs.
Result<void> analyse(AnalysisContext& context, const Analysis& analysis, const Directive& c, const RunOptions& options,
                     MeasurementSet& measures, const DeviceCurrents& currents, RunOutcome& out) {
    AnalysisRun run{&c, {}, 0, {}, {}, {}};
    FourierTransforms fourier(*context.circuit);
    PointDispatcher dispatcher(*context.circuit, options, out.saved_curves, measures, c.name == "tran" ? &fourier : nullptr, run, currents);
    double last_progress = 0;
    if (options.should_stop) {
        context.should_stop = [&](double progress) { return options.should_stop(c.name, last_progress = progress); };
        context.newton.should_stop = [&] { return options.should_stop(c.name, last_progress); };
    }
    context.points = &dispatcher;
    auto result = analysis.run(context, c);
    context.points = nullptr, context.should_stop = {}, context.newton.should_stop = {};
    if (!result) return result.error();
    run.result = std::move(*result);
    for (const auto& number : run.result.numbers) out.numbers.push_back(number);
    for (const auto& warning : run.result.warnings) out.warnings.push_back(warning);
    run.spectra = fourier.spectra();
    for (const auto& spectrum : run.spectra) out.numbers.emplace_back(spectrum.distortion_name(), spectrum.distortion());
    out.left_out.insert(out.left_out.end(), dispatcher.left_out.begin(), dispatcher.left_out.end());
    const auto& states = run.result.states;
    const auto set_states = [&](std::size_t point) {
        if (dispatcher.plot_count == 0 && point < states.size()) context.system.set_states(states[point]);  // for the currents of devices
    };
    for (const auto& plot : run.result.plots) TRY(PlotPoints(plot).send_to(dispatcher, set_states));
    run.result.plots = std::move(dispatcher.plots);
    out.analyses.push_back(std::move(run));
    return {};
}

}  // namespace

Result<RunOutcome> run_directives(std::shared_ptr<const Circuit> circuit, const RunOptions& options) {
    auto context = TRY(AnalysisContext::make(std::move(circuit)));
    return run_directives(*context, options);
}

Result<RunOutcome> run_directives(AnalysisContext& context, const RunOptions& options) {
    const Circuit* const circuit = context.circuit.get();
    RunOutcome out;
    if (!context.is_brief) {
        out.warnings = circuit->warnings;
        for (auto& warning : netlist_warnings(*circuit)) out.warnings.push_back(std::move(warning));
    }
    const auto saved = TRY(resolve_saved_quantities(context.system));
    for (const auto& curve : saved) out.saved_curves.push_back(curve.name);
    auto all_currents = saved;
    for (auto& current : mentioned_device_currents(context.system, saved)) all_currents.push_back(std::move(current));
    const DeviceCurrents currents(context.system, all_currents);
    // Checked in the first run of the context only.
    if (!std::exchange(context.output_directives_checked, true)) TRY(check_output_directives(context.system, currents, out.warnings));
    MeasurementSet measures(*circuit);
    for (const auto& c : circuit->directives) {
        const auto* analysis = find_analysis(c.name);
        if (analysis == nullptr) continue;
        if (auto ok = analyse(context, *analysis, c, options, measures, currents, out); !ok) {
            auto error = ok.error();
            // An error without a line gets the location of the directive.
            if (error.location.line == 0 && (error.location.file.empty() || error.location.file == circuit->file))
                error.location = c.location;
            return error;
        }
    }
    if (out.analyses.empty()) {
        std::string known;
        for (const auto* a : analyses) known += fmt::format("{}{}", known.empty() ? "" : "; ", a->usage);
        return error_at({circuit->file}, "the netlist has no analysis directive; add one of these: {}", known);
    }
    TRY(measures.finish(out.numbers, out.warnings, out.left_out));
    out.warnings.insert(out.warnings.end(), out.left_out.begin(), out.left_out.end());
    TRY(check_expectations(*circuit, out));
    return out;
}

std::optional<double> RunOutcome::find_number(std::string_view name) const {
    for (const auto& [known, value] : numbers)
        if (known == name) return value;
    const auto last = [&](const Plot& plot) -> std::optional<double> {
        const auto values = find_curve_values(plot, name);
        return values && !values->empty() ? std::optional(values->back().real()) : std::nullopt;
    };
    for (const auto& a : analyses) {
        if (const auto value = last(a.last_point)) return value;
        for (const auto& plot : a.result.plots)
            if (const auto value = last(plot)) return value;
    }
    return {};
}

std::vector<Plot> RunOutcome::plots(const AnalysisRun& a) const {
    std::vector<Plot> out;
    for (const auto& plot : a.result.plots) out.push_back(select_curves(plot, saved_curves));
    return out;
}

std::vector<Plot> RunOutcome::plots() const {
    std::vector<Plot> out;
    for (const auto& a : analyses)
        for (auto& plot : plots(a)) out.push_back(std::move(plot));
    return out;
}

}  // namespace corpuscle::circuit
