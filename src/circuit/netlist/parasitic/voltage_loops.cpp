#include "circuit/netlist/parasitic/voltage_loops.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"
#include "circuit/netlist/node_sets.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {

bool fixes_voltage(const Element& e) { return has_branch_current(e) && !(value_or(e.values, "rser", 0) > 0); }

void add_resistance_in_loops(Circuit& c) {
    constexpr double resistance = 1e-3;  // ohm
    NodeSets sets(c.nodes.size());
    for (const auto& e : c.elements)
        if (fixes_voltage(e) && !has_role(e, Role::inductor)) sets.join(e.nodes[0], e.nodes[1]);
    for (auto& e : c.elements) {
        if (!fixes_voltage(e) || !has_role(e, Role::inductor) || e.nodes[0] == e.nodes[1] || sets.join(e.nodes[0], e.nodes[1])) continue;
        e.values["rser"] = resistance;
        c.warnings.push_back(error_at(e.location,
                                      "{}: closes a loop with sources or other inductors, so nothing determines its direct current; {} in "
                                      "series is assumed, or write rser=OHM",
                                      e.name, format_quantity(resistance, "ohm")));
    }
}

}  // namespace corpuscle::circuit
