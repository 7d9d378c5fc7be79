#include "api/circuit_columns.hpp"

#include <algorithm>

#include "api/result.hpp"
#include "circuit/analyses.hpp"
#include "circuit/output/curve_view.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

using circuit::Plot, circuit::PlotRow;

/// The unit of a curve of this type, as in ngspice.
std::string_view unit_of_type(std::string_view type) {
    constexpr std::pair<std::string_view, std::string_view> units[] = {
        {"voltage", "V"}, {"current", "A"}, {"time", "s"}, {"frequency", "Hz"}, {"temp-sweep", "C"}};
    const auto* const found = std::ranges::find(units, type, &std::pair<std::string_view, std::string_view>::first);
    return found == std::end(units) ? "" : found->second;
}

/// The type of a curve of this unit.
std::string type_of_unit(std::string_view unit) {
    return unit == "V" ? "voltage" : unit == "A" ? "current" : unit == "s" ? "time" : unit == "Hz" ? "frequency" : "notype";
}

/// The plot without its values, for CurveView.
Plot head_of(const CircuitPlot& plot) {
    Plot out{plot.name, plot.is_complex, plot.has_sweep, {}, plot.inner_points};
    for (const auto& c : plot.columns) out.curves.push_back({c.name, type_of_unit(c.unit), {}});
    return out;
}

/// The values of a computed curve at all points.
CircuitColumn evaluate(const CircuitPlot& plot, const circuit::CurveView& view, const std::string& name) {
    CircuitColumn out{name, ""};
    std::vector<double> real(plot.columns.size());
    std::vector<std::complex<double>> complex(plot.columns.size());
    for (std::size_t k = 0; k < plot.points(); ++k) {
        for (std::size_t c = 0; c < plot.columns.size(); ++c) {
            const auto& column = plot.columns[c];
            plot.is_complex ? void(complex[c] = column.values.empty() ? column.complex_values[k] : column.values[k])
                            : void(real[c] = column.values[k]);
        }
        const auto value = plot.is_complex ? view.value(PlotRow(complex)) : view.value(PlotRow(real));
        plot.is_complex ? out.complex_values.push_back(value) : out.values.push_back(value.real());
    }
    const auto is_real = [](std::complex<double> x) { return x.imag() == 0; };
    if (plot.is_complex && std::ranges::all_of(out.complex_values, is_real)) {  // a part, such as vdb(out)
        for (const auto& x : out.complex_values) out.values.push_back(x.real());
        out.complex_values.clear();
    }
    return out;
}

/// The computed curve; no value if the plot has no such curve. The unit is known for a difference, such as v(a,b).
std::optional<CircuitColumn> compute(const CircuitPlot& plot, const std::string& name) {
    const auto head = head_of(plot);
    const auto text = lower(name);  // the view refers to both
    const auto view = circuit::CurveView::find(head, text);
    if (!view) return {};
    auto out = evaluate(plot, *view, name);
    if (text.starts_with("v(") && text.find(')') == text.size() - 1) out.unit = "V";
    return out;
}

InputError no_curve(const std::vector<const CircuitPlot*>& plots, const std::string& name) {
    std::vector<std::string> known;
    for (const auto* plot : plots)
        for (const auto& c : plot->columns) known.push_back(c.name);
    const auto suggestion = did_you_mean(lower(name), std::vector<std::string_view>(known.begin(), known.end()));
    constexpr std::size_t most = 8;
    const auto count = known.size();
    known.resize(std::min(count, most));
    return InputError(fmt::format("there is no curve '{}'{}{}", name, suggestion,
                                  !suggestion.empty() ? ""
                                  : known.empty()     ? "; the result has no curves"
                                                      : fmt::format("; there are {}{}", joined(known), count > most ? " ..." : "")));
}

}  // namespace

Result<void> api::ColumnCollector::begin(const Plot& head) {
    CircuitPlot plot{head.name, "", head.has_sweep, head.is_complex, head.inner_points};
    for (const auto& curve : head.curves) plot.columns.push_back({curve.name, std::string(unit_of_type(curve.type))});
    plots.push_back(std::move(plot));
    return {};
}

Result<void> api::ColumnCollector::add_point(const PlotRow& row) {
    auto& plot = plots.back();
    for (std::size_t k = 0; k < row.size(); ++k) {
        auto& column = plot.columns[k];
        const bool is_swept = k == 0 && plot.has_sweep;  // frequencies are real
        row.is_complex() && !is_swept ? column.complex_values.push_back(row[k]) : column.values.push_back(row[k].real());
    }
    return {};
}

void api::name_analyses(std::vector<CircuitPlot>& plots, const circuit::RunOutcome& outcome) {
    std::size_t at = 0;
    for (const auto& a : outcome.analyses)
        for (std::size_t k = 0; k < circuit::find_analysis(a.directive->name)->plot_count && at < plots.size(); ++k, ++at) {
            auto& plot = plots[at];
            plot.analysis = a.directive->name;
            if (plot.analysis != "noise" || a.directive->words.size() < 2) continue;
            const std::string density = plot.has_sweep ? "/sqrt(Hz)" : "";
            for (auto& c : plot.columns) {
                const auto& quantity = a.directive->words[c.name.starts_with("onoise") ? 0 : 1];  // v(out), v1
                if (c.unit.empty()) c.unit = (quantity.starts_with('i') ? "A" : "V") + density;
            }
        }
}

const CircuitColumn* CircuitPlot::find(const std::string& wanted) const {
    const auto found = std::ranges::find(columns, lower(wanted), &CircuitColumn::name);
    return found == columns.end() ? nullptr : &*found;
}

CircuitColumn CircuitPlot::column(const std::string& wanted) const {
    if (const auto* found = find(wanted)) return *found;
    if (auto computed = compute(*this, wanted)) return std::move(*computed);
    throw no_curve({this}, wanted);
}

CircuitColumn CircuitResult::column(const std::string& wanted) const {
    if (!steps.empty())
        throw InputError(fmt::format("'{}': the result has {} steps; take the curve of one: steps[0]", wanted, steps.size()));
    if (!error.empty()) throw InputError(error);
    std::vector<const CircuitPlot*> all;
    for (const auto& plot : plots) {
        if (const auto* found = plot.find(wanted)) return *found;
        all.push_back(&plot);
    }
    for (const auto& plot : plots)
        if (auto computed = compute(plot, wanted)) return std::move(*computed);
    throw no_curve(all, wanted);
}

double CircuitResult::measure(const std::string& wanted) const {
    std::vector<std::string_view> known;
    for (const auto& [known_name, value] : measures) {
        if (known_name == lower(wanted)) return value;
        known.push_back(known_name);
    }
    throw InputError(fmt::format("there is no measure '{}'{}", wanted, did_you_mean(lower(wanted), known)));
}

}  // namespace corpuscle
