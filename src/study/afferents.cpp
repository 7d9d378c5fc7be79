#include "study/afferents.hpp"

#include <fmt/format.h>
#include <deque>
#include <limits>

#include "circuit/afferent.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/traced.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

using circuit::CircuitDesign;

/// Parameters, and the names that their rows speak of.
struct ToldPlan {
    std::deque<std::string> words;
    std::vector<Parameter> parameters;
    std::vector<double> values;

    void add(std::string name, std::string sentence, double initial, double value, bool set, bool one_for_all = true) {
        constexpr double any = std::numeric_limits<double>::max();
        const auto& kept = words.emplace_back(std::move(name));
        parameters.push_back({{kept, "", initial, -any, any, words.emplace_back(std::move(sentence)), "", one_for_all}, "netlist", set});
        values.push_back(value);
    }
};

/// A device's number as it stands in a circuit, or as it is where nobody says it; "" is its value.
double number_of(const circuit::Circuit& c, std::string_view element, std::string_view name) {
    const int k = c.element(element);
    if (k < 0) return 0;
    const auto& e = c.elements[static_cast<std::size_t>(k)];
    if (const auto said = e.values.find(name); said != e.values.end()) return said->second;
    if (name.empty()) return e.letter == 'v' || e.letter == 'i' ? e.waveform.dc : e.value;
    if (e.letter == 'm')
        for (const auto& f : circuit::UicmInstance::fields)
            if (f.name == name) return circuit::UicmInstance{}.*f.at;
    return name == "m" || name == "area" ? 1 : name == "temp" ? c.temperature : 0;
}

/// A netlist's parameters, then what else is set of it; the defaults are those of the netlist as it is written.
Result<void> tell(AfferentPlan& plan, const CircuitDesign& design) {
    auto told = std::make_shared<ToldPlan>();
    const auto& changes = design.netlist->changes();
    const auto plain = design.netlist->with({}).elaborate();
    if (!plain) return plain.error();
    for (const auto& [name, written] : design.netlist->parameters())
        if (written.own || changes.parameters.contains(name))
            told->add(name, fmt::format(".param {}={}", name, written.text), plain->parameters.at(name),
                      design.circuit->parameters.at(name), changes.parameters.contains(name), false);
    for (const auto& [element, numbers] : changes.numbers)
        for (const auto& [name, value] : numbers)
            told->add(name.empty() ? element : element + "." + name, "a device's own", number_of(*plain, element, name), value, true);
    if (changes.temperature) told->add("temp", "temperature, degrees Celsius", plain->temperature, *changes.temperature, true);
    if (changes.mismatch)
        told->add("mismatch", "seed of the chip's own thresholds and currents", static_cast<double>(*changes.mismatch),
                  static_cast<double>(*changes.mismatch), true);
    if (changes.chip > 0) told->add("chip", "its number among those of the seed", 0, static_cast<double>(changes.chip), true);
    plan.values = told->values;
    plan.parameters = {told, &told->parameters};
    return {};
}

/// What of the traces asked for the circuit has, as .save has it.
Result<std::vector<std::string>> traces_in(const circuit::Circuit& circuit, const OfNetlists& asked) {
    asked.traced.resize(asked.traces.size());
    std::vector<std::string> out;
    for (std::size_t k = 0; k < asked.traces.size(); ++k) {
        const auto found = circuit::traced(circuit, asked.traces[k]);
        if (!found) return found.error();
        if (*found)
            asked.traced[k] = true, out.push_back(**found);
        else if (asked.hint.empty())
            asked.hint = meant_trace(circuit, asked.traces[k]);
    }
    return out;
}

Result<AfferentPlan> plan_netlist(std::string_view text, std::span<const Wish> wishes, const OfNetlists& asked) {
    const auto* carried = circuit::carried_netlist(text);
    const std::string name(carried ? carried->name : text);
    auto knobs = asked.knobs;
    for (const auto& wish : wishes) {
        const auto knob = knob_named(wish, text);
        if (!knob) continue;
        wish.used = true;
        knobs.push_back({*knob, wish.value, "--set " + wish.text()});
    }
    asked.used = true;
    auto netlist = circuit::tuned(name, knobs);
    if (!netlist) return netlist.error();
    if (!asked.traces.empty()) {
        const auto circuit = netlist->elaborate();
        if (!circuit) return circuit.error();
        auto traces = traces_in(*circuit, asked);
        if (!traces) return traces.error();
        auto changes = netlist->changes();
        changes.saved_alone = !traces->empty(), changes.saved = std::move(*traces);
        netlist = netlist->with(std::move(changes));
    }
    const auto design = CircuitDesign::of(*netlist);
    if (!design) return design.error();
    AfferentPlan plan;
    plan.name = name;
    plan.sentence = (*design)->title();
    plan.design = *design;
    if (auto ok = tell(plan, **design); !ok) return ok.error();
    return plan;
}

/// The error of a name that nobody knows, where it is one of a netlist's that was meant.
Error unknown(std::string_view text, Error error) {
    std::vector<std::string_view> names;
    for (const auto& a : named_afferents()) names.push_back(a.name);
    for (const auto& c : circuit::carried_netlists) names.push_back(c.name);
    const auto small = lower(text);
    const auto hint = did_you_mean(small, names);
    for (const auto& c : circuit::carried_netlists)
        if (text.find('+') == std::string_view::npos && hint.find(fmt::format("'{}'", c.name)) != std::string::npos)
            error.sentence = fmt::format("unknown afferent '{}'{} ('corpuscle list' shows them all)", text, hint);
    return error;
}

}  // namespace

std::optional<std::string> knob_named(const Wish& wish, std::string_view netlist) {
    const auto whole = wish.of + "." + wish.parameter;
    if (whole.size() <= netlist.size() + 1 || whole[netlist.size()] != '.') return {};
    const auto own = std::string_view(whole).substr(0, netlist.size());
    const bool same = circuit::carried_netlist(netlist) ? same_letters(own, netlist) : own == netlist;
    return same ? std::optional(whole.substr(netlist.size() + 1)) : std::nullopt;
}

Result<AfferentPlan> plan_any_afferent(std::string_view text, std::span<const Wish> wishes, const OfNetlists& asked) {
    if (names_netlist(text)) return plan_netlist(text, wishes, asked);
    auto plan = plan_afferent(text, wishes);
    return plan ? plan : unknown(text, plan.error());
}

Result<void> remake(AfferentPlan& copy, const AfferentPlan& original) {
    const auto design = std::dynamic_pointer_cast<const CircuitDesign>(original.design);
    if (!design || copy.values == original.values) return {};
    auto changes = design->netlist->changes();
    for (std::size_t k = 0; k < copy.values.size(); ++k)
        if (copy.values[k] != original.values[k])
            changes.parameters.insert_or_assign(std::string((*copy.parameters)[k].row.name), copy.values[k]);
    const auto made = CircuitDesign::of(design->netlist->with(std::move(changes)));
    if (!made) {
        auto error = made.error();
        error.sentence = fmt::format("{}: {}", copy.name, error.sentence);
        return error;
    }
    copy.design = *made;
    return {};
}

}  // namespace corpuscle
