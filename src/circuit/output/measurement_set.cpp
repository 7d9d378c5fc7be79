#include "circuit/output/measurement_set.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/expression/expression.hpp"
#include "circuit/measure/measurement_parser.hpp"

namespace corpuscle::circuit {
namespace {

bool is_expression(const Directive& c) { return c.words.size() > 2 && c.words[2].starts_with("param="); }

using KnownNumbers = std::vector<std::pair<std::string, double>>;

/// Parses param='EXPRESSION', which may use numbers of the analyses and results of earlier measurements.
Result<Expression> parse_expression(const Directive& c, const KnownNumbers& numbers) {
    ExpressionScope scope;
    scope.parameter = [&](std::string_view name) -> std::optional<double> {
        for (const auto& [known, value] : numbers)
            if (known == name) return value;
        return {};
    };
    scope.function = [](std::string_view) -> const ExpressionScope::Function* { return nullptr; };
    for (const auto& [known, value] : numbers) scope.suggestions.push_back(known);
    auto inside = c.words[2].substr(6);  // after "param="
    if (inside.size() > 1 && (inside.front() == '\'' || inside.front() == '{')) inside = inside.substr(1, inside.size() - 2);
    return Expression::parse(inside, c.location, scope);
}

Error without_analysis(const Directive& c) {
    return bad_input(fmt::format(".meas: the netlist has no .{} to measure", c.words[0]), c.location);
}
Error incomplete_measure(const Directive& c) {
    return bad_input(".meas: expected .meas op|dc|ac|noise|tran NAME MEASUREMENT ...", c.location);
}

}  // namespace

MeasurementSet::MeasurementSet(const Circuit& circuit) {
    for (const auto& c : circuit.directives)
        if (c.name == "meas" || c.name == "measure") entries_.push_back({&c, nullptr});
}

Result<void> MeasurementSet::begin(std::string_view analysis, const Plot& head) {
    active_.clear();
    for (auto& entry : entries_) {
        // A line that has a measurement already measured an earlier analysis of this kind.
        const auto& c = *entry.directive;
        if (c.words.size() < 3 || c.words[0] != analysis || is_expression(c) || entry.measurement) continue;
        entry.measurement = TRY(parse_measurement(c, head));
        active_.push_back(entry.measurement.get());
    }
    return {};
}

Result<void> MeasurementSet::add_plot(std::string_view analysis, const Plot& plot) {
    if (auto ok = begin(analysis, plot); !ok || active_.empty()) return ok;
    std::vector<std::complex<double>> row(plot.curves.size());
    for (std::size_t k = 0; k < plot.point_count(); ++k) {
        for (std::size_t n = 0; n < row.size(); ++n) row[n] = plot.curves[n].values[k];
        add_point(plot.has_sweep ? row[0].real() : 0, {row, plot.is_complex});
    }
    return {};
}

Result<void> MeasurementSet::check(const std::vector<std::string>& number_names) const {
    KnownNumbers known;  // the values are arbitrary, since only the names matter
    for (const auto& name : number_names) known.emplace_back(name, 1.0);
    for (const auto& [directive, measurement] : entries_) {
        const auto& c = *directive;
        if (c.words.size() < 3) return incomplete_measure(c);
        if (is_expression(c)) {
            TRY(parse_expression(c, known));
        } else if (!measurement) {
            return without_analysis(c);
        }
        known.emplace_back(c.words[1], 1.0);
    }
    return {};
}

Result<void> MeasurementSet::finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& warnings) const {
    for (const auto& [directive, measurement] : entries_) {
        const auto& c = *directive;
        if (c.words.size() < 3) return incomplete_measure(c);
        if (is_expression(c)) {
            const auto expression = TRY(parse_expression(c, numbers));
            numbers.emplace_back(c.words[1], expression.value());
            continue;
        }
        if (!measurement) return without_analysis(c);
        const double value = measurement->value();
        if (std::isnan(value)) warnings.push_back(bad_input(fmt::format(".meas {}: nothing was found", c.words[1]), c.location));
        numbers.emplace_back(c.words[1], value);
    }
    return {};
}

}  // namespace corpuscle::circuit
