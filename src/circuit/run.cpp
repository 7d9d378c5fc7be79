#include "circuit/run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "circuit/analyses.hpp"
#include "circuit/curves.hpp"
#include "circuit/measure.hpp"
#include "circuit/narrow.hpp"
#include "circuit/netlist/number.hpp"
#include "circuit/own_currents.hpp"
#include "circuit/print.hpp"
#include "circuit/requests.hpp"
#include "circuit/saved.hpp"
#include "circuit/solve/topology.hpp"
#include "circuit/warnings.hpp"
#include "signal/parameter.hpp"

namespace corpuscle::circuit {
namespace {

/// Parses "v(out) 0.35 1%" or "v(out)=0.35 2m".
Result<Expectation> expectation_of(const Command& c) {
    auto words = c.words;
    if (words.size() == 2 && words[0].find('=') != std::string::npos) {  // v(out)=0.35 1%
        const auto at = words[0].find('=');
        words.insert(words.begin() + 1, words[0].substr(at + 1));
        words[0].resize(at);
    }
    if (words.size() != 3) return bad_input(".expect: expected .expect NAME VALUE TOLERANCE, such as '.expect v(out) 0.35 1%'", c.place);
    const bool is_relative = words[2].ends_with('%');
    const auto value = whole_number(words[1]), tolerance = whole_number(is_relative ? words[2].substr(0, words[2].size() - 1) : words[2]);
    if (!value) return bad_input(fmt::format(".expect: '{}' is not a number", words[1]), c.place);
    if (!tolerance || !(tolerance->value >= 0))
        return bad_input(fmt::format(".expect: '{}' is not a tolerance; write one such as 1% or 2m", words[2]), c.place);
    return Expectation{words[0], value->value, is_relative ? std::abs(value->value) * tolerance->value / 100 : tolerance->value,
                       0,        false,        c.place};
}

Result<void> check_expectations(const Circuit& circuit, RunOutcome& out) {
    for (const auto& c : circuit.commands) {
        if (c.name != "expect") continue;
        auto e = expectation_of(c);
        if (!e) return e.error();
        const auto found = out.number(e->what);
        if (!found) {
            std::vector<std::string_view> known;
            for (const auto& [name, value] : out.numbers) known.push_back(name);
            return bad_input(fmt::format(".expect: there is no measurement, number or curve '{}'{}", e->what, did_you_mean(e->what, known)),
                             c.place);
        }
        e->found = *found, e->held = std::abs(*found - e->expected) <= e->tolerance;
        out.expectations.push_back(std::move(*e));
    }
    return {};
}

/// A number of .tran STEP STOP [START ...]; 0 if it is missing.
double tran_number(const Command& c, std::size_t word) { return number_of(c, word, "a number") ? *number_of(c, word, "a number") : 0; }

/// Passes each point of a transient to the measurements, to .print, to the sinks of the options and, if requested, to memory. Only the
/// last of these grows with the length of the run.
class PointDispatcher final : public PointSink {
    const RunOrders& options_;
    RunOutcome& out_;
    Measures& measures_;
    Analysed& analysed_;
    OwnCurrents currents_;
    std::optional<PrintedSteps> printed_;
    Narrow selector_;
    std::optional<KeptPlot> recorder_;
    std::vector<double> last_;
    PointSink* unknowns_ = nullptr;
    bool begun_ = false;

public:
    PointDispatcher(const Circuit& circuit, const RunOrders& options, RunOutcome& out, Measures& measures, Analysed& analysed,
                    const OwnCurrents& currents)
        : options_(options), out_(out), measures_(measures), analysed_(analysed), currents_(currents) {
        const auto& c = *analysed.command;
        if (options.print && c.name == "tran") printed_.emplace(circuit, tran_number(c, 2), tran_number(c, 0), tran_number(c, 1));
        if (options.keep) recorder_.emplace();
    }
    bool begun() const { return begun_; }

    Result<void> begin(const Plot& unknowns) override {
        Plot head = unknowns;
        currents_.add_to(head);
        analysed_.last = head;
        unknowns_ = analysed_.command->name == "tran" ? options_.unknowns : nullptr;
        if (unknowns_)
            if (auto ok = unknowns_->begin(head); !ok) return ok;
        if (auto ok = measures_.begin(analysed_.command->name, head); !ok) return ok;
        if (printed_)
            if (auto ok = printed_->begin(head); !ok) return ok;
        if (recorder_)
            if (auto ok = recorder_->begin(head); !ok) return ok;
        begun_ = true;
        const auto selected_head = selector_.begin(head, out_.saved);
        return options_.curves ? options_.curves->begin(selected_head) : Result<void>();
    }
    Result<void> point(std::span<const double> unknowns) override {
        const auto row = currents_.point(unknowns);
        ++analysed_.points;
        last_.assign(row.begin(), row.end());
        measures_.point(row[0], row);
        if (printed_) printed_->point(row);
        if (unknowns_)
            if (auto ok = unknowns_->point(row); !ok) return ok;
        if (recorder_)
            if (auto ok = recorder_->point(row); !ok) return ok;
        return options_.curves ? options_.curves->point(selector_.point(row)) : Result<void>();
    }
    Result<void> end() override {
        for (std::size_t k = 0; k < last_.size(); ++k) analysed_.last.curves[k].values = {last_[k]};
        if (printed_) analysed_.printed = printed_->end();
        return options_.curves ? options_.curves->end() : Result<void>();
    }
    /// Moves the kept points into the result of the analysis.
    void move_points_to(Findings& found) {
        if (recorder_) found.plots.insert(found.plots.begin(), std::move(recorder_->plot));
    }
};

/// Runs one analysis; measures, prints and passes on its plots.
Result<void> analyse(TestBench& context, const Analysis& analysis, const Command& c, const RunOrders& options, Measures& measures,
                     const OwnCurrents& currents, RunOutcome& out) {
    Analysed done{&c, {}, 0, {}, {}};
    PointDispatcher dispatcher(*context.circuit, options, out, measures, done, currents);
    if (options.stop) context.stop = [&](double progress) { return options.stop(c.name, progress); };
    context.points = &dispatcher;
    auto found = analysis.run(context, c);
    context.points = nullptr, context.stop = {};
    if (!found) return found.error();
    done.findings = std::move(*found);
    for (const auto& number : done.findings.numbers) out.numbers.push_back(number);
    for (const auto& warning : done.findings.remarks) out.remarks.push_back(warning);
    if (dispatcher.begun()) {
        dispatcher.move_points_to(done.findings);
    } else if (!done.findings.plots.empty()) {
        for (auto& plot : done.findings.plots) (void)currents.complete(plot);
        const auto& plot = done.findings.plots[0];
        done.points = plot.points();
        if (auto ok = measures.see(c.name, plot); !ok) return ok;
        if (options.print) done.printed = printed(*context.circuit, c.name, plot);
        if (options.curves)
            if (auto ok = options.curves->whole(out.plots(done)); !ok) return ok;
    }
    out.analyses.push_back(std::move(done));
    return {};
}

}  // namespace

Result<RunOutcome> run(std::shared_ptr<const Circuit> circuit, const RunOrders& options) {
    auto context = TestBench::make(std::move(circuit));
    if (!context) return context.error();
    return run(**context, options);
}

Result<RunOutcome> run(TestBench& context, const RunOrders& options) {
    const Circuit* const circuit = context.circuit.get();
    RunOutcome out;
    if (!context.brief) {
        out.remarks = circuit->remarks;
        for (auto& warning : suspicious(*circuit)) out.remarks.push_back(std::move(warning));
        for (auto& warning : warnings_of(*circuit)) out.remarks.push_back(std::move(warning));
    }
    const auto saved = saved_of(context.system);
    if (!saved) return saved.error();
    for (const auto& curve : *saved) out.saved.push_back(curve.name);
    const OwnCurrents currents(context.system, *saved);
    if (!std::exchange(context.requests_checked, true))
        if (auto ok = check_requests(context.system, currents, out.remarks); !ok) return ok.error();
    Measures measures(*circuit);
    for (const auto& c : circuit->commands) {
        const auto* analysis = analysis_of(c.name);
        if (analysis == nullptr) continue;
        if (auto ok = analyse(context, *analysis, c, options, measures, currents, out); !ok) {
            auto error = ok.error();
            if (error.location.line == 0 && (error.location.file.empty() || error.location.file == circuit->file)) error.location = c.place;
            return error;
        }
    }
    if (out.analyses.empty()) {
        std::string known;
        for (const auto& a : analyses) known += fmt::format("\n  {}", a.usage);
        return bad_input("the netlist has no analysis directive; add one of these:" + known, SourceLocation{circuit->file});
    }
    if (auto ok = measures.finish(out.numbers, out.remarks); !ok) return ok.error();
    if (auto ok = check_expectations(*circuit, out); !ok) return ok.error();
    return out;
}

std::optional<double> RunOutcome::number(std::string_view name) const {
    for (const auto& [known, value] : numbers)
        if (known == name) return value;
    const auto last = [&](const Plot& plot) -> std::optional<double> {
        const auto values = values_of(plot, name);
        return values && !values->empty() ? std::optional(values->back().real()) : std::nullopt;
    };
    for (const auto& a : analyses) {
        if (const auto value = last(a.last)) return value;
        for (const auto& plot : a.findings.plots)
            if (const auto value = last(plot)) return value;
    }
    return {};
}

std::vector<Plot> RunOutcome::plots(const Analysed& a) const {
    std::vector<Plot> out;
    for (const auto& plot : a.findings.plots) out.push_back(narrowed(plot, saved));
    return out;
}

std::vector<Plot> RunOutcome::plots() const {
    std::vector<Plot> out;
    for (const auto& a : analyses)
        for (auto& plot : plots(a)) out.push_back(std::move(plot));
    return out;
}

}  // namespace corpuscle::circuit
