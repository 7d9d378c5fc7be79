#include "circuit/run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/analyses.hpp"
#include "circuit/curves.hpp"
#include "circuit/measure.hpp"
#include "circuit/netlist/number.hpp"
#include "circuit/saved.hpp"
#include "circuit/solve/topology.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {
namespace {

/// "0.35 1%" or "0.35 2m" after a name, with or without "=".
Result<Expectation> expectation_of(const Command& c) {
    auto words = c.words;
    if (words.size() == 2 && words[0].find('=') != std::string::npos) {  // v(out)=0.35 1%
        const auto at = words[0].find('=');
        words.insert(words.begin() + 1, words[0].substr(at + 1));
        words[0].resize(at);
    }
    if (words.size() != 3) return bad_input(".expect: it is .expect NAME VALUE TOLERANCE, such as '.expect v(out) 0.35 1%'", c.place);
    const bool share = words[2].ends_with('%');
    const auto value = whole_number(words[1]), tolerance = whole_number(share ? words[2].substr(0, words[2].size() - 1) : words[2]);
    if (!value) return bad_input(fmt::format(".expect: '{}' is no number", words[1]), c.place);
    if (!tolerance || !(tolerance->value >= 0))
        return bad_input(fmt::format(".expect: '{}' is no tolerance, such as 1% or 2m", words[2]), c.place);
    return Expectation{words[0], value->value, share ? std::abs(value->value) * tolerance->value / 100 : tolerance->value,
                       0,        false,        c.place};
}

/// A number that a name means once all is done: of a measure or an analysis, or at the last point of the first plot that has it.
std::optional<double> number_named(const RunOutcome& out, std::string_view name) {
    for (const auto& [known, value] : out.numbers)
        if (known == name) return value;
    for (const auto& a : out.analyses)
        for (const auto& plot : a.findings.plots)
            if (const auto values = values_of(plot, name); values && !values->empty()) return values->back().real();
    return {};
}

Result<void> expect(const Circuit& circuit, RunOutcome& out) {
    for (const auto& c : circuit.commands) {
        if (c.name != "expect") continue;
        auto e = expectation_of(c);
        if (!e) return e.error();
        const auto found = number_named(out, e->what);
        if (!found) {
            std::vector<std::string_view> known;
            for (const auto& [name, value] : out.numbers) known.push_back(name);
            return bad_input(fmt::format(".expect: nothing is called '{}'{}", e->what, did_you_mean(e->what, known)), c.place);
        }
        e->found = *found, e->held = std::abs(*found - e->expected) <= e->tolerance;
        out.expectations.push_back(std::move(*e));
    }
    return {};
}

/// The plot with the curves named, where it has one of them; a plot of another kind (noise, transfer function) as it is.
Plot narrowed(const Plot& plot, const std::vector<std::string>& names) {
    Plot out{plot.name, plot.is_complex, plot.swept, {}};
    if (plot.swept && !plot.curves.empty()) out.curves.push_back(plot.curves[0]);
    bool any = false;
    for (const auto& name : names)
        if (auto values = values_of(plot, name)) {
            any = true;
            out.curves.push_back({name, name[0] == 'v' ? "voltage" : "current", std::move(*values)});
        }
    return any ? out : plot;
}

}  // namespace

Result<RunOutcome> run(std::shared_ptr<const Circuit> circuit, const RunStop& stop) {
    auto bench = TestBench::make(std::move(circuit));
    if (!bench) return bench.error();
    return run(**bench, stop);
}

Result<RunOutcome> run(TestBench& bench, const RunStop& stop) {
    const Circuit* const circuit = bench.circuit.get();
    RunOutcome out;
    if (!bench.brief) {
        out.remarks = circuit->remarks;
        for (auto& s : suspicious(*circuit)) out.remarks.push_back(std::move(s));
    }
    const auto saved = saved_of(bench.system);
    if (!saved) return saved.error();
    for (const auto& curve : *saved) out.saved.push_back(curve.name);
    bool any = false;
    for (const auto& c : circuit->commands) {
        const auto* analysis = analysis_of(c.name);
        if (analysis == nullptr) continue;
        any = true;
        if (stop) bench.stop = [&](double share) { return stop(c.name, share); };
        auto found = analysis->run(bench, c);
        bench.stop = {};
        if (!found) {
            auto error = found.error();
            if (error.place.line == 0) error.place = c.place;
            return error;
        }
        for (const auto& number : found->numbers) out.numbers.push_back(number);
        for (const auto& remark : found->remarks) out.remarks.push_back(remark);
        out.analyses.push_back({&c, std::move(*found)});
    }
    if (!any) {
        std::string known;
        for (const auto& a : analyses) known += fmt::format("\n  {}", a.usage);
        return bad_input("the netlist asks for no analysis; there are" + known, Place{circuit->file});
    }
    if (auto ok = measure(*circuit, out); !ok) return ok.error();
    if (auto ok = expect(*circuit, out); !ok) return ok.error();
    return out;
}

std::vector<Plot> RunOutcome::plots() const {
    std::vector<Plot> out;
    for (const auto& a : analyses)
        for (const auto& plot : a.findings.plots) out.push_back(narrowed(plot, saved));
    return out;
}

std::string printed(const Circuit& circuit, const Analysed& a) {
    std::string out;
    for (const auto& c : circuit.commands) {
        if (c.name != "print" || a.findings.plots.empty()) continue;
        const bool named = !c.words.empty() && analysis_of(c.words[0]) != nullptr;
        if (named && c.words[0] != a.command->name) continue;
        const Plot& plot = a.findings.plots[0];
        std::vector<std::pair<std::string, std::vector<std::complex<double>>>> columns;
        if (plot.swept) columns.emplace_back(plot.curves[0].name, plot.curves[0].values);
        for (std::size_t w = named ? 1 : 0; w < c.words.size(); ++w)
            if (auto values = values_of(plot, c.words[w])) columns.emplace_back(c.words[w], std::move(*values));
        if (columns.size() < (plot.swept ? 2U : 1U)) continue;
        for (const auto& [name, values] : columns) out += fmt::format("{:>16}", name);
        out += '\n';
        for (std::size_t point = 0; point < plot.points(); ++point) {
            for (const auto& [name, values] : columns)
                out += values[point].imag() == 0 ? fmt::format("{:16.7e}", values[point].real())
                                                 : fmt::format(" {:.7e},{:.7e}", values[point].real(), values[point].imag());
            out += '\n';
        }
    }
    return out;
}

}  // namespace corpuscle::circuit
