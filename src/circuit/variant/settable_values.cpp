#include "circuit/variant/settable_values.hpp"

#include <limits>

#include "circuit/cost/power.hpp"
#include "circuit/devices.hpp"
#include "circuit/variant/hierarchical_names.hpp"
#include "circuit/variant/named_value.hpp"

namespace corpuscle::circuit {
namespace {

/// The subcircuit of the top level in which an element is; "" if it is in none.
std::string subcircuit_block(const Element& e) { return e.name.find('.') == std::string::npos ? "" : Blocks::name_of_node(e.name); }

/// The name under which a user sets a device: "summer.n3b" for xsummer.mn3b, "vdd" at the top level.
std::string device_name(const Element& e) {
    const auto pieces = piece_count(e.name);
    return pieces > 1 ? short_name(e.name, pieces, LastPiece::element) : e.name;
}

/// A voltage source of 0 V, which measures a current.
bool is_ammeter(const Element& e) { return has_role(e, Role::voltage_source) && e.waveform.dc == 0; }

void add_array(const Element& e, std::vector<SettableValue>& out) {
    const auto columns = named_value_of(e, "m"), units = named_value_of(e, "stack");
    if (!columns || !units) return;
    SettableValue array{.name = device_name(e), .kind = SettableValue::Kind::array, .block = subcircuit_block(e)};
    array.text = fmt::format("{:g}x{:g}", columns->value, units->value);
    array.description = "columns x transistors in series";
    out.push_back(std::move(array));
}

void add_numbers(const Element& e, std::vector<SettableValue>& out) {
    if (e.expression || e.waveform.shape != Waveform::Shape::none || is_ammeter(e)) return;
    for (const auto& p : kind_of(e).parameters) {
        const auto suffix = p.is_value ? std::string() : "." + std::string(p.name);
        const bool is_in_array = has_role(e, Role::transistor) && (p.name == "m" || p.name == "stack");
        const auto value = named_value_of(e, p.is_value ? "" : p.name);
        if (!value || is_in_array || p.name == "temp" || p.name == "dtemp") continue;
        SettableValue number{.name = device_name(e) + suffix, .unit = std::string(p.unit), .value = value->value};
        number.block = subcircuit_block(e);
        number.description = kind_of(e).description;
        out.push_back(std::move(number));
    }
}

}  // namespace

std::vector<SettableValue> settable_values_of(const Circuit& circuit) {
    std::vector<SettableValue> out;
    out.push_back({.name = "temp", .value = circuit.temperature, .description = "temperature, degrees Celsius"});
    out.push_back({.name = "mismatch",
                   .value = circuit.mismatch_seed ? static_cast<double>(*circuit.mismatch_seed) : std::numeric_limits<double>::quiet_NaN(),
                   .description = "seed of the device mismatch of a chip; without a seed the circuit is nominal"});
    for (const auto& e : circuit.elements) {
        if (has_role(e, Role::transistor)) add_array(e, out);
        add_numbers(e, out);
    }
    return out;
}

}  // namespace corpuscle::circuit
