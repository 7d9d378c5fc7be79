#include "circuit/netlist/parasitic/parasitics.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"
#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {
namespace {

struct Parasitic {
    std::string_view name, unit;
    char letter;
    bool is_in_series;
};
constexpr Parasitic parasitics[] = {
    {"rser", "ohm", 'r', true}, {"lser", "H", 'l', true}, {"rpar", "ohm", 'r', false}, {"cpar", "F", 'c', false}};

/// True if the device itself has this parasitic.
bool is_part_of_device(const Element& e, const Parasitic& p) { return has_role(e, Role::inductor) && p.name == "rser"; }

}  // namespace

Result<void> add_parasitics(CircuitBuilder& builder, Element& e, double m) {
    if (!has_role(e, Role::capacitor) && !has_role(e, Role::inductor) && !has_role(e, Role::voltage_source)) return {};
    const double copies = value_or(e.values, "m", has_role(e, Role::voltage_source) ? m : 1);
    const int plus = e.nodes[0], minus = e.nodes[1];
    for (const auto& p : parasitics) {
        const auto given = e.values.find(p.name);
        if (given == e.values.end() || is_part_of_device(e, p)) continue;
        const double value = given->second;
        e.values.erase(given);
        if (!(value >= 0)) return error_at(e.location, "{}: {} = {:g} {} is below 0", e.name, p.name, value, p.unit);
        if (value == 0) continue;
        Element added;
        added.name = fmt::format("{}#{}", e.name, p.name);
        added.kind = find_device_kind(p.letter), added.letter = p.letter, added.location = e.location, added.value = value;
        if (copies != 1) added.values["m"] = copies;
        added.nodes = {plus, minus};
        if (p.is_in_series) {  // between the element and what is in series already
            added.nodes = {builder.add_inner_node(added.name), e.nodes[1]};
            e.nodes[1] = added.nodes[0];
        }
        TRY(builder.add_element(std::move(added)));
    }
    return {};
}

}  // namespace corpuscle::circuit
