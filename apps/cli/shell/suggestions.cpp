#include "cli/shell/suggestions.hpp"

#include <algorithm>

#include "circuit/variant/netlist_overrides.hpp"
#include "run/catalogue/catalogue_sections.hpp"
#include "skin/contact/contact.hpp"
#include "skin/contact/indenters.hpp"

namespace corpuscle {
namespace {

using Names = std::vector<std::string>;

std::vector<ListEntry> entries_of(std::string_view section) {
    for (const auto& s : catalogue_sections())
        if (s.name == section) return s.entries();
    return {};
}

/// The names of entries, without examples such as "path/own.cir" and "grid 8x8".
Names names_of(const std::vector<ListEntry>& entries) {
    Names out;
    for (const auto& e : entries)
        if (!e.is_pattern) out.push_back(e.name);
    return out;
}

template <class Table>
Names names_in(const Table& table) {
    Names out;
    for (const auto& row : table) out.emplace_back(row.name);
    return out;
}

Names joined_lists(Names first, const Names& second) { return first.insert(first.end(), second.begin(), second.end()), first; }

/// "NAME.PARAMETER=" for each parameter of the entries. `target` replaces the names of the entries.
void add_settings(Names& to, const std::vector<ListEntry>& entries, const std::string& target = {}) {
    for (const auto& e : entries)
        for (const auto& p : e.parameters) to.push_back((target.empty() ? e.name : target) + "." + std::string(p.info.name) + "=");
}

}  // namespace

Names afferent_names() { return names_of(entries_of("afferents")); }
Names population_names() { return names_of(entries_of("skins")); }
Names live_population_names() { return joined_lists(population_names(), afferent_names()); }
Names indenter_names() { return names_in(indenters); }
Names stimulus_names() { return names_of(entries_of("stimuli")); }
Names force_names() { return joined_lists(stimulus_names(), names_in(named_touches())); }
Names measure_names() { return names_of(entries_of("measures")); }
Names netlist_names() { return names_in(circuit::embedded_netlists); }

Names setting_names() {
    Names out;
    add_settings(out, entries_of("afferents"));
    add_settings(out, entries_of("stimuli"));
    add_settings(out, entries_of("contact"), "contact");
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

Names catalogue_names() {
    Names out;
    for (const auto& section : catalogue_sections()) out.emplace_back(section.name);
    for (const auto& section : catalogue_sections())
        for (auto& name : names_of(section.entries())) out.push_back(std::move(name));
    return out;
}

}  // namespace corpuscle
