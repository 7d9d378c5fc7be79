#include "circuit/variant/named_value.hpp"

#include <algorithm>
#include <set>

#include "circuit/devices.hpp"
#include "circuit/variant/hierarchical_names.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The value of an element's parameter; its initial value if the netlist does not give it.
double value_of(const Element& e, const ElementParameter& p) {
    if (p.is_value) return e.waveform.has_dc ? e.waveform.dc : e.value;
    const auto at = e.values.find(p.name);
    return at == e.values.end() ? p.initial : at->second;
}

}  // namespace

std::optional<NamedValue> named_value_of(const Element& e, std::string_view name) {
    for (const auto& p : kind_of(e).parameters) {
        if (!(name.empty() ? p.is_value : p.name == name) || (e.expression && !p.works_with_expression)) continue;
        return NamedValue{value_of(e, p), std::string(p.unit), name.empty() ? e.name : e.name + "." + std::string(name), false,
                          name == "m" || name == "stack"};
    }
    return {};
}

std::optional<NamedValue> find_named_value(const Circuit& circuit, std::string_view typed) {
    const auto name = lower(typed);
    if (const auto p = circuit.parameters.find(name); p != circuit.parameters.end()) return NamedValue{p->second, "", name, true};
    std::vector<std::string_view> names;
    for (const auto& e : circuit.elements) names.push_back(e.name);
    if (const auto found = find_matching_names(names, name, LastPiece::element); found.size() == 1)
        if (auto value = named_value_of(circuit.elements[found[0]], "")) return value;
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) return {};
    const auto owners = find_matching_names(names, std::string_view(name).substr(0, dot), LastPiece::element);
    if (owners.size() != 1) return {};
    return named_value_of(circuit.elements[owners[0]], std::string_view(name).substr(dot + 1));
}

std::string unit_of_difference(const Circuit& a, const Circuit& b) {
    std::set<std::string_view> units;
    for (std::size_t k = 0; k < std::min(a.elements.size(), b.elements.size()); ++k) {
        const auto &x = a.elements[k], &y = b.elements[k];
        if (x.kind != y.kind) return "";
        for (const auto& p : kind_of(x).parameters)
            if (value_of(x, p) != value_of(y, p)) units.insert(p.unit);
    }
    return units.size() == 1 ? std::string(*units.begin()) : "";
}

}  // namespace corpuscle::circuit
