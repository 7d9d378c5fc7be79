// Reads the variables of an optimization file.

#include <fmt/format.h>
#include <cmath>

#include "circuit/variant/named_value.hpp"
#include "core/text/quantity.hpp"
#include "optimize/problem_text.hpp"

namespace corpuscle::optimize {
namespace {

class VariableReader {
    const ProblemText& text_;
    const sweeps::PlannedSweep& sweep_;

public:
    VariableReader(const ProblemText& text, const sweeps::PlannedSweep& sweep) : text_(text), sweep_(sweep) {}

    Result<std::vector<DesignVariable>> read() const {
        std::vector<DesignVariable> out;
        std::size_t axis = 0;
        for (std::size_t k = 0; k < text_.names.size(); ++k) {
            const auto& node = text_.variables()[k];
            auto& v = out.emplace_back();
            const auto& name = text_.names[k][0];
            const auto& first = sweep_.plan().axes[axis];
            if (!first.column.labels.empty())
                return node.get("from")->error_here(
                    fmt::format("{}: the bounds must be numbers; for the columns of an array write what = \"{}.m\"", name.text, name.text));
            v.min = first.values[0], v.max = first.values[1], v.unit = first.column.unit;
            for (const auto& n : text_.names[k]) v.names.push_back(n.text);
            axis += text_.names[k].size();
            if (!(v.min <= v.max))
                return node.get("from")->error_here(fmt::format("{}: the bounds cross: from = {} is above to = {}; exchange them",
                                                                name.text, node.get("from")->text, node.get("to")->text));
            v.is_logarithmic = TRY(flag_of(node, "log")), v.is_integer = TRY(flag_of(node, "integer"));
            if (v.is_logarithmic && !(v.min > 0))
                return node.get("log")->error_here(fmt::format("{}: log = true needs bounds above 0", name.text));
            TRY(read_start(node, text_.names[k], v));
            if (v.is_integer && (v.min != std::floor(v.min) || v.max != std::floor(v.max)))
                return node.get("from")->error_here(fmt::format("{}: the bounds of an integer must be integers", name.text));
        }
        return out;
    }

private:
    /// Reads or finds the value before the optimization, and checks the units.
    Result<void> read_start(const ConfigNode& node, const std::vector<LocatedText>& names, DesignVariable& v) const {
        std::optional<double> start;
        const auto* circuit = sweep_.nominal_circuit();
        for (const auto& name : names) {
            if (!circuit) break;
            const auto found = circuit::find_named_value(*circuit, name.text);
            if (!found) continue;
            if (!start) start = found->value;
            v.is_integer = v.is_integer || found->is_count;
            TRY(check_unit(node, name, *found, v));
        }
        if (const auto* given = node.get("start")) {
            const auto number = circuit ? TRY(given->located(circuit::parse_number_with_unit(given->text), "start: ")).value
                                        : TRY(given->located(parse_quantity(given->text, v.unit), "start: "));
            start = number;
        }
        if (!start) return names[0].error_here(fmt::format("{}: 'start' is missing: the value before the optimization", names[0].text));
        if (!(*start >= v.min && *start <= v.max))
            return (node.has("start") ? *node.get("start") : names[0])
                .error_here(fmt::format("{}: its {}value {} is outside the bounds [{}, {}]; {}", names[0].text,
                                        node.has("start") ? "start " : "present ", format_quantity(*start, v.unit),
                                        format_quantity(v.min, v.unit), format_quantity(v.max, v.unit),
                                        node.has("start") ? "choose a value between them" : "widen them, or give a start between them"));
        v.start = *start;
        return {};
    }

    /// Checks that both bounds have a unit of the quantity. That of a .param is the unit of the device values that depend on it.
    Result<void> check_unit(const ConfigNode& node, const LocatedText& name, const circuit::NamedValue& found, DesignVariable& v) const {
        auto unit = found.unit;
        if (found.is_parameter && found.value != 0) {
            const auto netlist = TRY(sweep_.netlist().nominal());
            const auto changed = netlist.elaborate({{found.full_name, found.value * 1.0625}});
            if (changed) unit = circuit::unit_of_difference(*sweep_.nominal_circuit(), *changed);
        }
        for (const auto* key : {"from", "to", "start"}) {
            const auto* given = node.get(key);
            if (!given) continue;
            const auto number = TRY(given->located(circuit::parse_number_with_unit(given->text), name.text + ": "));
            if (number.unit.empty() || unit.empty() || number.unit == unit) continue;
            return given->error_here(
                fmt::format("{}: {} = {} has the unit {}, but {} is in {}", name.text, key, given->text, number.unit, name.text, unit));
        }
        if (!unit.empty()) v.unit = unit;
        return {};
    }
};

}  // namespace

Result<std::vector<DesignVariable>> read_variables(const ProblemText& text, const sweeps::PlannedSweep& sweep) {
    return VariableReader(text, sweep).read();
}

}  // namespace corpuscle::optimize
