#include "run/catalogue/catalogue_sections.hpp"

#include <memory>

#include "circuit/analyses.hpp"
#include "circuit/device/mos/ekv_card.hpp"
#include "circuit/device/mos/mos1_card.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/devices.hpp"
#include "core/stimulus/stimuli.hpp"
#include "io/recording/recording_formats.hpp"
#include "measure/measures.hpp"
#include "run/afferent_plan.hpp"

namespace corpuscle {
namespace {

ListEntry entry_of(const CatalogEntry& model) {
    auto e = list_entry(model.name, "", model.description, model.source);
    for (const auto& row : model.parameters) e.parameters.push_back({row, model.name});
    return e;
}

/// An entry for each row of a table. `entry` makes it from the row.
template <class Table, class MakeEntry>
std::vector<ListEntry> entries_of(const Table& table, std::string_view detail_key, MakeEntry entry) {
    std::vector<ListEntry> entries;
    for (const auto& row : table) entries.push_back(entry(row)), entries.back().detail_key = detail_key;
    return entries;
}

std::vector<ListEntry> entries_of(const std::vector<CatalogEntry>& models) { return entries_of(models, "", entry_of); }

/// Keeps an object alive until the program ends. It is used for parameters of netlists, to whose names the entries only refer.
template <class T>
const std::shared_ptr<T>& keep_alive(const std::shared_ptr<T>& object) {
    static std::vector<std::shared_ptr<T>> all;
    return all.emplace_back(object);
}

std::vector<ListEntry> afferent_entries() {
    std::vector<ListEntry> entries;
    const auto add = [&](std::string_view name, const AfferentPlan& plan, const std::string& description, std::string_view source) {
        entries.push_back(list_entry(name, plan.composition(), description, source));
        entries.back().parameters = *keep_alive(plan.parameters);
        entries.back().is_implementation = plan.traits().is_implementation;
    };
    for (const auto& a : named_afferents()) {
        add(a.name, *plan_afferent(a.name), std::string(a.description), a.source);
        entries.back().other_names.assign(a.aliases.begin(), a.aliases.end());
    }
    for (const auto& c : circuit::embedded_netlists)
        if (const auto plan = plan_any_afferent(c.name))
            add(plan->result.name, plan->result,
                std::string(plan->result.description) + "; also settable: temp, corner, mismatch, every array and device (doc/circuits.md)",
                c.file);
    entries.push_back(list_pattern("path/own.cir", "netlist",
                                   "any netlist with a force input (a source with FORCE) and a spike output (.spike)",
                                   "doc/circuits.md; circuits/spiker.cir"));
    entries.push_back(
        list_pattern("path/own.nir", "NIR graph", "any NIR graph with one input, the force in N, and one output of spikes", "doc/nir.md"));
    return entries;
}

/// Devices of netlists by letter.
std::vector<ListEntry> device_entries() {
    const auto element = [](const auto* d) { return list_entry({&d->letter, 1}, "", d->description); };
    return entries_of(circuit::device_kinds, "", element);
}

/// Parameters of .model and M lines.
std::vector<ListEntry> netlist_model_entries() {
    using namespace circuit;
    return entries_of({{UicmCard::name, UicmCard::description, UicmCard::source, parameters_of<UicmCard>(UicmCard::fields)},
                       {Mos1Card::name, Mos1Card::description, Mos1Card::source, parameters_of<Mos1Card>(Mos1Card::fields)},
                       {EkvCard::name, EkvCard::description, EkvCard::source, parameters_of<EkvCard>(EkvCard::fields)},
                       {"m", "size of a UICM transistor: the parameters of an M line", "choice: 1 um / 1 um",
                        parameters_of<UicmInstance>(UicmInstance::fields)}});
}

std::vector<ListEntry> analysis_entries() {
    const auto analysis = [](const auto* a) { return list_entry("." + std::string(a->name), a->usage, a->description); };
    return entries_of(circuit::analyses, "usage", analysis);
}

std::vector<ListEntry> measure_entries() {
    return entries_of(measures, "unit", [](const auto& m) { return list_entry(m.name, m.unit, m.description); });
}

std::vector<ListEntry> format_entries() {
    return entries_of(recording_formats, "extensions", [](const auto& f) { return list_entry(f.name, f.extensions, f.description); });
}

constexpr CatalogueSection sections[] = {
    {"afferents", afferent_entries},
    {"sensors", [] { return entries_of(sensor_entries()); }},
    {"transducers", [] { return entries_of(transducer_entries()); }},
    {"converters", [] { return entries_of(converter_entries()); }},
    {"receptors", [] { return entries_of(receptor_entries()); }},
    {"neurons", [] { return entries_of(neuron_entries()); }},
    {"stimuli", [] { return entries_of(stimulus_catalog()); }},
    {"measures", measure_entries},
    {"formats", format_entries},
    {"skins", skin_entries},
    {"contact", contact_entries},
    {"devices", device_entries},
    {"models", netlist_model_entries},
    {"analyses", analysis_entries},
};

}  // namespace

std::span<const CatalogueSection> catalogue_sections() { return sections; }

}  // namespace corpuscle
