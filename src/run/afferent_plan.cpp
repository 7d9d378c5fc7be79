#include "run/afferent_plan.hpp"

#include <fmt/format.h>
#include <deque>
#include <limits>

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/output/resolve_probe.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

using circuit::CircuitAfferentFactory;

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
double number_of(const circuit::Circuit& c, std::string_view element, std::string_view name) {
    const int k = c.find_element(element);
    if (k < 0) return 0;
    const auto& e = c.elements[static_cast<std::size_t>(k)];
    if (const auto found = e.values.find(name); found != e.values.end()) return found->second;
    if (name.empty()) return e.letter == 'v' || e.letter == 'i' ? e.waveform.dc : e.value;
    if (e.letter == 'm')
        for (const auto& f : circuit::UicmInstance::fields)
            if (f.name == name) return circuit::UicmInstance{}.*f.member;
    return name == "m" || name == "area" ? 1 : name == "temp" ? c.temperature : 0;
}

/// Lists in `plan` the .param parameters of a netlist, then the other values that the user has overridden (of devices, temperature and
/// mismatch). The defaults are the values written in the netlist.
Result<void> describe_parameters(AfferentPlan& plan, const CircuitAfferentFactory& design) {
    auto described = std::make_shared<NetlistParameters>();
    const auto& changes = design.netlist->overrides();
    const auto original = design.netlist->with_overrides({}).elaborate();
    if (!original) return original.error();
    for (const auto& [name, written] : design.netlist->parameters())
        if (written.is_defined_in_netlist || changes.parameters.contains(name))
            described->add(name, fmt::format(".param {}={}", name, written.text), original->parameters.at(name),
                           design.circuit->parameters.at(name), changes.parameters.contains(name), false);
    for (const auto& [element, numbers] : changes.numbers)
        for (const auto& [name, value] : numbers)
            described->add(name.empty() ? element : element + "." + name, "parameter of one device", number_of(*original, element, name),
                           value, true);
    if (changes.temperature) described->add("temp", "temperature, degrees Celsius", original->temperature, *changes.temperature, true);
    if (changes.mismatch_seed)
        described->add("mismatch", "seed of the chip's device mismatch", static_cast<double>(*changes.mismatch_seed),
                       static_cast<double>(*changes.mismatch_seed), true);
    if (changes.chip > 0) described->add("chip", "index of the chip for this seed", 0, static_cast<double>(changes.chip), true);
    plan.values = described->values;
    plan.parameters = {described, &described->parameters};
    return {};
}

/// The requested probes that the circuit has, with the names that .save uses.
Result<std::vector<std::string>> probes_in(const circuit::Circuit& circuit, const NetlistOptions& options) {
    options.probe_found.resize(options.probes.size());
    std::vector<std::string> out;
    for (std::size_t k = 0; k < options.probes.size(); ++k) {
        const auto found = circuit::resolve_probe(circuit, options.probes[k]);
        if (!found) return found.error();
        if (*found)
            options.probe_found[k] = true, out.push_back(**found);
        else if (options.probe_hint.empty())
            options.probe_hint = suggest_probe(circuit, options.probes[k]);
    }
    return out;
}

/// Plans the netlist that `text` names, with the settings that are for this netlist.
Result<AfferentPlan> plan_netlist(std::string_view text, std::span<const ParameterOverride> settings, const NetlistOptions& options) {
    const auto* embedded = circuit::find_embedded_netlist(text);
    const std::string name(embedded ? embedded->name : text);
    auto overrides = options.overrides;
    for (const auto& setting : settings) {
        const auto override_name = netlist_override_name(setting, text);
        if (!override_name) continue;
        setting.is_used = true;
        overrides.push_back({*override_name, setting.value, "--set " + setting.text()});
    }
    options.is_used = true;
    auto netlist = circuit::apply_overrides(name, overrides);
    if (!netlist) return netlist.error();
    if (!options.probes.empty()) {
        const auto circuit = netlist->elaborate();
        if (!circuit) return circuit.error();
        auto probes = probes_in(*circuit, options);
        if (!probes) return probes.error();
        auto changes = netlist->overrides();
        changes.replaces_saved = !probes->empty(), changes.saved = std::move(*probes);
        netlist = netlist->with_overrides(std::move(changes));
    }
    const auto design = CircuitAfferentFactory::create(*netlist);
    if (!design) return design.error();
    AfferentPlan plan;
    plan.name = name;
    plan.description = (*design)->title();
    plan.factory = *design;
    if (auto ok = describe_parameters(plan, **design); !ok) return ok.error();
    return plan;
}

/// The error for an unknown name: `error`, which suggests catalogue afferents, or a suggestion of an embedded netlist if its name is the
/// most similar.
Error unknown_afferent(std::string_view text, Error error) {
    std::vector<std::string_view> names;
    for (const auto& a : named_afferents()) names.push_back(a.name);
    for (const auto& c : circuit::embedded_netlists) names.push_back(c.name);
    const auto lowercase = lower(text);
    const auto hint = did_you_mean(lowercase, names);
    for (const auto& c : circuit::embedded_netlists)
        if (text.find('+') == std::string_view::npos && hint.find(fmt::format("'{}'", c.name)) != std::string::npos)
            error.message = fmt::format("unknown afferent '{}'{} ('corpuscle list' shows them all)", text, hint);
    return error;
}

}  // namespace

std::optional<std::string> netlist_override_name(const ParameterOverride& setting, std::string_view netlist) {
    const auto full_name = setting.target + "." + setting.parameter;
    if (full_name.size() <= netlist.size() + 1 || full_name[netlist.size()] != '.') return {};
    const auto prefix = std::string_view(full_name).substr(0, netlist.size());
    const bool same = circuit::find_embedded_netlist(netlist) ? equal_ignoring_case(prefix, netlist) : prefix == netlist;
    return same ? std::optional(full_name.substr(netlist.size() + 1)) : std::nullopt;
}

Result<AfferentPlan> plan_any_afferent(std::string_view text, std::span<const ParameterOverride> settings, const NetlistOptions& options) {
    if (names_netlist(text)) return plan_netlist(text, settings, options);
    auto plan = plan_afferent(text, settings);
    return plan ? plan : unknown_afferent(text, plan.error());
}

Result<void> rebuild_copy(AfferentPlan& copy, const AfferentPlan& original) {
    const auto design = std::dynamic_pointer_cast<const CircuitAfferentFactory>(original.factory);
    if (!design || copy.values == original.values) return {};
    auto changes = design->netlist->overrides();
    for (std::size_t k = 0; k < copy.values.size(); ++k)
        if (copy.values[k] != original.values[k])
            changes.parameters.insert_or_assign(std::string((*copy.parameters)[k].info.name), copy.values[k]);
    const auto factory = CircuitAfferentFactory::create(design->netlist->with_overrides(std::move(changes)));
    if (!factory) {
        auto error = factory.error();
        error.message = fmt::format("{}: {}", copy.name, error.message);
        return error;
    }
    copy.factory = *factory;
    return {};
}

}  // namespace corpuscle
