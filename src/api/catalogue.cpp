#include "corpuscle/catalogue.hpp"

#include <algorithm>
#include <limits>

#include "api/result.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "core/stimulus/stimuli.hpp"
#include "io/recording/recording_formats.hpp"
#include "measure/measures.hpp"
#include "model/catalog.hpp"
#include "run/afferent_plan.hpp"
#include "skin/contact/contact.hpp"
#include "skin/contact/indenters.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {
namespace {

using Entries = std::vector<CatalogueEntry>;

CatalogueEntry entry(std::string_view name, std::string_view detail, std::string_view description, std::string_view source = {}) {
    return {std::string(name), std::string(detail), std::string(description), std::string(source), {}};
}

ParameterDescription parameter(const ParameterInfo& p, std::string_view source_of_entry) {
    constexpr double largest = std::numeric_limits<double>::max(), infinite = std::numeric_limits<double>::infinity();
    return {std::string(p.name),
            std::string(p.unit),
            p.default_value,
            p.low > -largest ? p.low : -infinite,
            p.high < largest ? p.high : infinite,
            std::string(p.description),
            std::string(p.source.empty() ? source_of_entry : p.source)};
}

Entries entries_of(const std::vector<CatalogEntry>& all) {
    Entries out;
    for (const auto& e : all) {
        out.push_back(entry(e.name, "", e.description, e.source));
        for (const auto& p : e.parameters) out.back().parameters.push_back(parameter(p, e.source));
    }
    return out;
}

Entries afferents() {
    Entries out;
    const auto add = [&](std::string_view name, const AfferentPlan& plan, std::string_view description, std::string_view source) {
        out.push_back(entry(name, plan.composition(), description, source));
        for (std::size_t k = 0; k < plan.values.size(); ++k) out.back().parameters.push_back(parameter((*plan.parameters)[k].info, source));
    };
    for (const auto& a : named_afferents()) add(a.name, api::value_or_throw(plan_afferent(a.name)), a.description, a.source);
    for (const auto& c : circuit::embedded_netlists) {
        const auto plan = api::value_or_throw(plan_any_afferent(c.name)).result;
        add(plan.name, plan, plan.description, c.file);
    }
    return out;
}

Entries measure_entries() {
    Entries out;
    for (const auto& m : measures) out.push_back(entry(m.name, m.unit, m.description));
    return out;
}

Entries format_entries() {
    Entries out;
    for (const auto& f : recording_formats) out.push_back(entry(f.name, f.extensions, f.description));
    return out;
}

Entries skins() {
    Entries out;
    for (const auto& s : named_skins()) out.push_back(entry(s.name, "", s.description, "skins/" + s.name + ".toml"));
    return out;
}

/// Indenters with the parameters that each uses, and named touches.
Entries contacts() {
    Entries out;
    const auto all = contact_parameters();
    for (const auto& i : indenters) {
        out.push_back(entry(i.name, "indenter", i.description, i.source));
        for (const auto& p : all)
            if (std::find(i.parameters.begin(), i.parameters.end(), p.name) != i.parameters.end())
                out.back().parameters.push_back(parameter(p, i.source));
    }
    for (const auto& t : named_touches()) out.push_back(entry(t.name, "touch", t.description));
    return out;
}

struct Catalogue {
    std::string_view name;
    Entries (*entries)();
};
constexpr Catalogue all_catalogues[] = {
    {"afferents", afferents},
    {"sensors", [] { return entries_of(sensor_entries()); }},
    {"transducers", [] { return entries_of(transducer_entries()); }},
    {"converters", [] { return entries_of(converter_entries()); }},
    {"receptors", [] { return entries_of(receptor_entries()); }},
    {"neurons", [] { return entries_of(neuron_entries()); }},
    {"stimuli", [] { return entries_of(stimulus_catalog()); }},
    {"measures", measure_entries},
    {"formats", format_entries},
    {"skins", skins},
    {"contact", contacts},
};

}  // namespace

std::vector<std::string> catalogues() {
    std::vector<std::string> out;
    for (const auto& c : all_catalogues) out.emplace_back(c.name);
    return out;
}

std::vector<CatalogueEntry> catalogue(const std::string& name) {
    std::vector<std::string_view> known;
    for (const auto& c : all_catalogues) {
        if (c.name == name) return c.entries();
        known.push_back(c.name);
    }
    throw InputError("there is no catalogue '" + name + "'" + did_you_mean(name, known));
}

}  // namespace corpuscle
