#include "circuit/measure.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/measure/words.hpp"
#include "circuit/netlist/formula.hpp"

namespace corpuscle::circuit {
namespace {

bool is_expression(const Command& c) { return c.words.size() > 2 && c.words[2].starts_with("param="); }

using KnownNumbers = std::vector<std::pair<std::string, double>>;

/// Parses param='EXPRESSION', which may use the results of earlier measurements.
Result<Formula> parse_expression(const Command& c, const KnownNumbers& numbers) {
    FormulaScope scope;
    scope.parameter = [&](std::string_view name) -> std::optional<double> {
        for (const auto& [known, value] : numbers)
            if (known == name) return value;
        return {};
    };
    scope.function = [](std::string_view) -> const FormulaScope::Function* { return nullptr; };
    for (const auto& [known, value] : numbers) scope.known.push_back(known);
    auto inside = c.words[2].substr(6);
    if (inside.size() > 1 && (inside.front() == '\'' || inside.front() == '{')) inside = inside.substr(1, inside.size() - 2);
    return Formula::parse(inside, c.place, scope);
}

Error without_analysis(const Command& c) { return bad_input(fmt::format(".meas: the netlist has no .{} to measure", c.words[0]), c.place); }
Error incomplete_measure(const Command& c) { return bad_input(".meas: expected .meas op|dc|ac|noise|tran NAME WHAT ...", c.place); }

}  // namespace

Measures::Measures(const Circuit& circuit) {
    for (const auto& c : circuit.commands)
        if (c.name == "meas" || c.name == "measure") entries_.push_back({&c, nullptr});
}

Result<void> Measures::begin(std::string_view analysis, const Plot& head) {
    active_.clear();
    for (auto& entry : entries_) {
        const auto& c = *entry.command;
        if (c.words.size() < 3 || c.words[0] != analysis || is_expression(c) || entry.gauge) continue;
        auto made = gauge_of(c, head);
        if (!made) return made.error();
        entry.gauge = std::move(*made);
        active_.push_back(entry.gauge.get());
    }
    return {};
}

Result<void> Measures::see(std::string_view analysis, const Plot& plot) {
    if (auto ok = begin(analysis, plot); !ok || active_.empty()) return ok;
    std::vector<std::complex<double>> row(plot.curves.size());
    for (std::size_t k = 0; k < plot.points(); ++k) {
        for (std::size_t n = 0; n < row.size(); ++n) row[n] = plot.curves[n].values[k];
        point(plot.swept ? row[0].real() : 0, {row, plot.is_complex});
    }
    return {};
}

Result<void> Measures::check(const std::vector<std::string>& numbers) const {
    KnownNumbers known;
    for (const auto& name : numbers) known.emplace_back(name, 1.0);
    for (const auto& [command, measurement] : entries_) {
        const auto& c = *command;
        if (c.words.size() < 3) return incomplete_measure(c);
        if (is_expression(c)) {
            if (const auto expression = parse_expression(c, known); !expression) return expression.error();
        } else if (!measurement) {
            return without_analysis(c);
        }
        known.emplace_back(c.words[1], 1.0);
    }
    return {};
}

Result<void> Measures::finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& warnings) const {
    for (const auto& [command, measurement] : entries_) {
        const auto& c = *command;
        if (c.words.size() < 3) return incomplete_measure(c);
        if (is_expression(c)) {
            const auto expression = parse_expression(c, numbers);
            if (!expression) return expression.error();
            numbers.emplace_back(c.words[1], expression->value());
            continue;
        }
        if (!measurement) return without_analysis(c);
        const double value = measurement->value();
        if (std::isnan(value)) warnings.push_back(bad_input(fmt::format(".meas {}: nothing was found", c.words[1]), c.place));
        numbers.emplace_back(c.words[1], value);
    }
    return {};
}

}  // namespace corpuscle::circuit
