#include "circuit/analyses.hpp"
#include "circuit/devices.hpp"
#include "circuit/netlist/node_sets.hpp"
#include "circuit/netlist/parasitic/voltage_loops.hpp"
#include "circuit/solve/system.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The names of up to three elements at a node, and the number of the others.
std::string elements_at(const Circuit& c, int node) {
    std::vector<std::string> names;
    std::size_t more = 0;
    for (const auto& e : c.elements)
        if (std::find(e.nodes.begin(), e.nodes.end(), node) != e.nodes.end()) names.size() < 3 ? names.push_back(e.name) : void(++more);
    return fmt::format("{}{}", joined(names), more > 0 ? fmt::format(" and {} more", more) : "");
}

/// Rejects nodes without a path to ground for direct current. With `charges_conduct`, the charges of capacitors and transistors are paths,
/// too. The message describes the part of the circuit with the first of these nodes.
Result<void> check_floating_nodes(const Circuit& c, bool charges_conduct) {
    NodeSets sets(c.nodes.size());
    for (const auto& e : c.elements) {
        for (const int end : kind_of(e).conducting_nodes(e)) sets.join(end, e.nodes[0]);
        if (charges_conduct && (has_role(e, Role::capacitor) || has_role(e, Role::transistor)))
            for (const int node : e.nodes) sets.join(node, e.nodes[0]);
    }
    std::vector<int> floating;
    for (std::size_t n = 1; n < c.nodes.size(); ++n)
        if (sets.root(static_cast<int>(n)) != sets.root(0)) floating.push_back(static_cast<int>(n));
    if (floating.empty()) return {};
    const int first = floating[0];
    bool sources = false;     // a current source is connected to this part
    bool is_isolated = true;  // no element connects it to another part
    bool has_coils = false;   // it has inductors
    const Element* first_element = nullptr;
    std::vector<std::string> names;
    for (const int n : floating)
        if (sets.root(n) == sets.root(first) && names.size() < 4) names.push_back(c.nodes[static_cast<std::size_t>(n)]);
    for (const auto& e : c.elements) {
        const bool touches = std::any_of(e.nodes.begin(), e.nodes.end(), [&](int n) { return sets.root(n) == sets.root(first); });
        if (!touches) continue;
        if (first_element == nullptr) first_element = &e;
        is_isolated &= std::ranges::all_of(e.nodes, [&](int n) { return sets.root(n) == sets.root(first); });
        has_coils |= has_role(e, Role::inductor);
        sources |= has_role(e, Role::current_source) || is_current_expression(e);
    }
    const auto what = names.size() == 1 ? fmt::format("node '{}' has", names[0]) : fmt::format("nodes '{}' have", joined(names, "', '"));
    const auto why = is_isolated ? fmt::format("is not connected to ground{}, so nothing sets its voltage",
                                               has_coils ? " (a coupling of inductors connects no nodes)" : "")
                     : sources   ? std::string("is connected to ground only through current sources, so nothing sets its voltage")
                                 : std::string("is connected to ground through capacitors and gates at most, so nothing sets its voltage");
    const auto subject = names.size() == 1 ? "it" : "their part of the circuit";
    return error_at(first_element != nullptr ? first_element->location : SourceLocation{c.file},
                    "{} no path to ground{}: {} {} (connected: {}). Add a large resistor to ground", what,
                    charges_conduct ? "" : " for direct current", subject, why, elements_at(c, first));
}

Result<void> check_voltage_loops(const Circuit& c) {
    NodeSets sets(c.nodes.size());
    std::vector<const Element*> fixing;  // elements that fix a voltage and close no loop
    for (const auto& e : c.elements) {
        if (!fixes_voltage(e)) continue;
        if (sets.join(e.nodes[0], e.nodes[1])) {
            fixing.push_back(&e);
            continue;
        }
        if (e.nodes[0] == e.nodes[1])
            return error_at(e.location, "{}: both ends are connected to node '{}', so its voltage can only be 0", e.name,
                            c.nodes[static_cast<std::size_t>(e.nodes[0])]);
        std::vector<std::string> names;
        for (const auto* other : fixing)
            if (sets.root(other->nodes[0]) == sets.root(e.nodes[0]) && names.size() < 5) names.push_back(other->name);
        return error_at(e.location,
                        "{}: closes a loop of elements that each fix a voltage ({}), so the loop current is not determined; add "
                        "a small series resistor",
                        e.name, joined(names));
    }
    return {};
}

/// False if all analyses are transients that begin with given voltages (uic); the charges of capacitors then set the voltages of nodes.
bool needs_operating_point(const Circuit& c) {
    bool has_transient = false;
    for (const auto& d : c.directives) {
        if (d.name == "tran" && starts_from_initial_conditions(d))
            has_transient = true;
        else if (find_analysis(d.name) != nullptr)
            return true;
    }
    return !has_transient;
}

}  // namespace

Result<void> check_solvable(const Circuit& c) {
    if (c.elements.empty()) return error_at({c.file}, "the circuit has no elements");
    if (std::none_of(c.elements.begin(), c.elements.end(),
                     [](const Element& e) { return std::find(e.nodes.begin(), e.nodes.end(), 0) != e.nodes.end(); }))
        return error_at(c.elements[0].location, "no element is connected to ground (node 0)");
    TRY(check_voltage_loops(c));
    return check_floating_nodes(c, !needs_operating_point(c));
}

}  // namespace corpuscle::circuit
