#include "circuit/output/measurement_set.hpp"

#include <algorithm>

#include "circuit/expression/expression.hpp"
#include "circuit/measure/measurement.hpp"

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

Error without_analysis(const Directive& c) { return error_at(c.location, ".meas: the netlist has no .{} to measure", c.words[0]); }
Error incomplete_measure(const Directive& c) {
    return error_at(c.location, ".meas: expected .meas op|dc|ac|noise|tran NAME MEASUREMENT ...");
}

}  // namespace

MeasurementSet::MeasurementSet(const Circuit& circuit) {
    for (const auto& c : circuit.directives)
        if (c.name == "meas" || c.name == "measure") entries_.push_back({&c, nullptr});
}

Result<void> MeasurementSet::begin(std::string_view analysis, const Plot& head) {
    active_.clear(), has_sweep_ = head.has_sweep;
    for (auto& entry : entries_) {
        // A line that has a measurement already measured an earlier analysis of this kind.
        const auto& c = *entry.directive;
        if (c.words.size() < 3 || c.words[0] != analysis || is_expression(c) || entry.measurement) continue;
        entry.measurement = TRY(parse_measurement(c, head));
        active_.push_back(entry.measurement.get());
    }
    return {};
}

Result<void> MeasurementSet::check(const std::vector<std::string>& number_names) const {
    KnownNumbers known;  // the values are arbitrary, since only the names matter
    for (const auto& name : number_names) known.emplace_back(name, 1.0);
    std::vector<Error> warnings;
    return finish(known, warnings);
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
        if (std::isnan(value)) warnings.push_back(error_at(c.location, ".meas {}: nothing was found", c.words[1]));
        numbers.emplace_back(c.words[1], value);
    }
    return {};
}

}  // namespace corpuscle::circuit
