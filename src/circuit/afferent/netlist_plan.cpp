#include "circuit/afferent/netlist_plan.hpp"

#include <deque>

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/variant/netlist_overrides.hpp"

namespace corpuscle::circuit {
namespace {

/// Parameters of a netlist afferent and their values. `texts` stores the names and descriptions to which `parameters` refers; it is a
/// deque, because its elements must not move.
struct NetlistParameters {
    std::deque<std::string> texts;
    std::vector<AfferentParameter> parameters;
    std::vector<double> values;

    /// `initial`: the value in the netlist; `value`: the value in use; `shared_by_copies`: false if copies may have different values.
    void add(std::string name, std::string description, double initial, double value, bool set_by_user, bool shared_by_copies = true) {
        constexpr double limit = std::numeric_limits<double>::max();
        const auto& stored_name = texts.emplace_back(std::move(name));
        const auto& stored_description = texts.emplace_back(std::move(description));
        parameters.push_back({{stored_name, "", initial, -limit, limit, stored_description, "", shared_by_copies}, "netlist", set_by_user});
        values.push_back(value);
    }
};

/// A parameter of a device as set in a circuit, or its default; 0 if the circuit has no such device or parameter. An empty name means the
/// device's main value.
double number_of(const Circuit& c, std::string_view element, std::string_view name) {
    const int k = c.find_element(element);
    if (k < 0) return 0;
    const auto& e = c.elements[static_cast<std::size_t>(k)];
    if (const auto found = e.values.find(name); found != e.values.end()) return found->second;
    if (name.empty()) return main_value(e);
    if (name == "temp") return c.temperature;
    for (const auto& p : kind_of(e).parameters)
        if (p.name == name) return p.initial;
    return 0;
}

/// Lists in `plan` the .param parameters of a netlist, then the other values that the user has overridden (of devices, temperature and
/// mismatch). The defaults are the values written in the netlist.
Result<void> describe_parameters(AfferentPlan& plan, const CircuitAfferentFactory& design) {
    auto described = std::make_shared<NetlistParameters>();
    const auto& changes = design.netlist->overrides();
    const auto original = TRY(design.netlist->with_overrides({}).elaborate());
    for (const auto& [name, written] : design.netlist->parameters())
        if (written.is_defined_in_netlist || changes.parameters.contains(name))
            described->add(name, fmt::format(".param {}={}", name, written.text), original.parameters.at(name),
                           design.circuit->parameters.at(name), changes.parameters.contains(name), false);
    for (const auto& [element, numbers] : changes.numbers)
        for (const auto& [name, value] : numbers)
            described->add(name.empty() ? element : element + "." + name, "parameter of one device", number_of(original, element, name),
                           value, true);
    for (const auto& [name, value] : changes.options)
        described->add(name, "number of .options", value_or(original.options, name, 0), value, true);
    if (changes.temperature) described->add("temp", "temperature, degrees Celsius", original.temperature, *changes.temperature, true);
    if (changes.mismatch_seed)
        described->add("mismatch", "seed of the chip's device mismatch", static_cast<double>(*changes.mismatch_seed),
                       static_cast<double>(*changes.mismatch_seed), true);
    if (changes.chip > 0) described->add("chip", "index of the chip for this seed", 0, static_cast<double>(changes.chip), true);
    plan.values = described->values;
    plan.parameters = {described, &described->parameters};
    return {};
}

/// Finds the requested probes in the circuit of a netlist, and makes those that it has replace its .save quantities.
Result<std::vector<RequestedProbe>> request_probes(Netlist& netlist, std::span<const std::string> probes) {
    std::vector<RequestedProbe> out;
    if (probes.empty()) return out;
    const auto circuit = TRY(netlist.elaborate());
    auto changes = netlist.overrides();
    changes.saved.clear();
    for (const auto& probe : probes) {
        auto found = TRY(resolve_probe(circuit, probe));
        if (found) changes.saved.push_back(*found);
        out.push_back({found, found ? "" : suggest_probe(circuit, probe)});
    }
    changes.replaces_saved = !changes.saved.empty();
    netlist = netlist.with_overrides(std::move(changes));
    return out;
}

}  // namespace

Result<PlannedAfferent> NetlistSpec::plan(std::span<const ParameterOverride> overrides, std::span<const std::string> probes) const {
    const auto* embedded = find_embedded_netlist(text());
    const std::string name(embedded ? embedded->name : text());
    auto applied = TRY(apply_overrides(name, overrides));
    auto requested = TRY(request_probes(applied.result, probes));
    const auto design = TRY(CircuitAfferentFactory::create(applied.result));
    AfferentPlan plan;
    plan.name = name;
    plan.description = design->circuit->title;
    plan.factory = design;
    TRY(describe_parameters(plan, *design));
    return PlannedAfferent{{std::move(plan), std::move(applied.unused)}, std::move(requested)};
}

}  // namespace corpuscle::circuit
