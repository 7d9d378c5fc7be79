#include "circuit/run_directives.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "circuit/analyses.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/output/curve_selector.hpp"
#include "circuit/output/curve_view.hpp"
#include "circuit/output/device_currents.hpp"
#include "circuit/output/measurement_set.hpp"
#include "circuit/output/output_directives.hpp"
#include "circuit/output/print_directive.hpp"
#include "circuit/output/saved_quantities.hpp"
#include "circuit/solve/topology.hpp"
#include "circuit/variant/netlist_warnings.hpp"
#include "core/parameter.hpp"

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
    if (words.size() != 3) return bad_input(".expect: expected .expect NAME VALUE TOLERANCE, such as '.expect v(out) 0.35 1%'", c.location);
    const bool is_relative = words[2].ends_with('%');
    const auto value = parse_number(words[1]), tolerance = parse_number(is_relative ? words[2].substr(0, words[2].size() - 1) : words[2]);
    if (!value) return bad_input(fmt::format(".expect: '{}' is not a number", words[1]), c.location);
    if (!tolerance || !(tolerance->value >= 0))
        return bad_input(fmt::format(".expect: '{}' is not a tolerance; write one such as 1% or 2m", words[2]), c.location);
    return Expectation{words[0], value->value, is_relative ? std::abs(value->value) * tolerance->value / 100 : tolerance->value,
                       0,        false,        c.location};
}

Result<void> check_expectations(const Circuit& circuit, RunOutcome& out) {
    for (const auto& c : circuit.directives) {
        if (c.name != "expect") continue;
        auto e = TRY(expectation_of(c));
        const auto found = out.find_number(e.name);
        if (!found) {
            std::vector<std::string_view> known;
            for (const auto& [name, value] : out.numbers) known.push_back(name);
            return bad_input(fmt::format(".expect: there is no measurement, number or curve '{}'{}", e.name, did_you_mean(e.name, known)),
                             c.location);
        }
        e.actual = *found, e.is_met = std::abs(*found - e.expected) <= e.tolerance;
        out.expectations.push_back(std::move(e));
    }
    return {};
}

/// The number in a word of .tran STEP STOP [START ...]; 0 if there is none.
double tran_number(const Directive& c, std::size_t word) {
    return read_number(c, word, "a number") ? *read_number(c, word, "a number") : 0;
}

/// Passes each point of a transient to the measurements, to .print and to the sinks of the options. If options.keep_points is true, it also
/// stores the points, which takes memory in proportion to the length of the run. Other analyses do not use it.
class PointDispatcher final : public PointSink {
    const RunOptions& options_;
    RunOutcome& out_;
    MeasurementSet& measures_;
    AnalysisRun& run_;
    DeviceCurrents currents_;
    std::optional<TransientPrinter> printer_;
    CurveSelector selector_;
    std::optional<PlotRecorder> recorder_;
    std::vector<double> last_row_;
    PointSink* unknowns_sink_ = nullptr;
    bool has_begun_ = false;

public:
    PointDispatcher(const Circuit& circuit, const RunOptions& options, RunOutcome& out, MeasurementSet& measures, AnalysisRun& run,
                    const DeviceCurrents& currents)
        : options_(options), out_(out), measures_(measures), run_(run), currents_(currents) {
        const auto& c = *run.directive;
        if (options.print_tables && c.name == "tran") printer_.emplace(circuit, tran_number(c, 2), tran_number(c, 0), tran_number(c, 1));
        if (options.keep_points) recorder_.emplace();
    }
    bool has_begun() const { return has_begun_; }

    Result<void> begin(const Plot& unknowns) override {
        Plot head = unknowns;
        currents_.extend_head(head);
        run_.last_point = head;
        unknowns_sink_ = run_.directive->name == "tran" ? options_.unknowns_sink : nullptr;
        if (unknowns_sink_) TRY(unknowns_sink_->begin(head));
        TRY(measures_.begin(run_.directive->name, head));
        if (printer_) TRY(printer_->begin(head));
        if (recorder_) TRY(recorder_->begin(head));
        has_begun_ = true;
        const auto selected_head = selector_.begin(head, out_.saved_curves);
        return options_.curve_sink ? options_.curve_sink->begin(selected_head) : Result<void>();
    }
    Result<void> add_point(std::span<const double> unknowns) override {
        const auto row = currents_.extend_point(unknowns);
        ++run_.point_count;
        last_row_.assign(row.begin(), row.end());
        measures_.add_point(row[0], row);
        if (printer_) printer_->add_point(row);
        if (unknowns_sink_) TRY(unknowns_sink_->add_point(row));
        if (recorder_) TRY(recorder_->add_point(row));
        return options_.curve_sink ? options_.curve_sink->add_point(selector_.select(row)) : Result<void>();
    }
    Result<void> end() override {
        for (std::size_t k = 0; k < last_row_.size(); ++k) run_.last_point.curves[k].values = {last_row_[k]};
        if (printer_) run_.printed_tables = printer_->end();
        return options_.curve_sink ? options_.curve_sink->end() : Result<void>();
    }
    /// Moves the stored points into the result of the analysis.
    void move_points_to(AnalysisResult& result) {
        if (recorder_) result.plots.insert(result.plots.begin(), std::move(recorder_->plot));
    }
};

/// Runs one analysis, measures and prints its plots, and passes them to the sinks.
Result<void> analyse(AnalysisContext& context, const Analysis& analysis, const Directive& c, const RunOptions& options,
                     MeasurementSet& measures, const DeviceCurrents& currents, RunOutcome& out) {
    AnalysisRun run{&c, {}, 0, {}, {}};
    PointDispatcher dispatcher(*context.circuit, options, out, measures, run, currents);
    if (options.should_stop) context.should_stop = [&](double progress) { return options.should_stop(c.name, progress); };
    context.points = &dispatcher;
    auto result = analysis.run(context, c);
    context.points = nullptr, context.should_stop = {};
    if (!result) return result.error();
    run.result = std::move(*result);
    for (const auto& number : run.result.numbers) out.numbers.push_back(number);
    for (const auto& warning : run.result.warnings) out.warnings.push_back(warning);
    if (dispatcher.has_begun()) {
        dispatcher.move_points_to(run.result);
    } else if (!run.result.plots.empty()) {
        for (auto& plot : run.result.plots) (void)currents.extend_plot(plot);
        const auto& plot = run.result.plots[0];
        run.point_count = plot.point_count();
        TRY(measures.add_plot(c.name, plot));
        if (options.print_tables) run.printed_tables = print_tables(*context.circuit, c.name, plot);
        if (options.curve_sink) TRY(options.curve_sink->add_plots(out.plots(run)));
    }
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
        for (auto& warning : find_dangling_nodes(*circuit)) out.warnings.push_back(std::move(warning));
        for (auto& warning : netlist_warnings(*circuit)) out.warnings.push_back(std::move(warning));
    }
    const auto saved = TRY(resolve_saved_quantities(context.system));
    for (const auto& curve : saved) out.saved_curves.push_back(curve.name);
    const DeviceCurrents currents(context.system, saved);
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
        for (const auto& a : analyses) known += fmt::format("\n  {}", a.usage);
        return bad_input("the netlist has no analysis directive; add one of these:" + known, SourceLocation{circuit->file});
    }
    TRY(measures.finish(out.numbers, out.warnings));
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
