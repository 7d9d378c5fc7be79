#pragma once
// The sections and entries that `corpuscle list` prints.

#include "model/catalog.hpp"

namespace corpuscle {

/// A property of an entry other than a parameter: its name, its text, and the source of its value.
struct CatalogNote {
    std::string subject, text, source;
};

struct ListEntry {
    std::string name;
    std::string detail;  ///< such as the composition of an afferent; printed in parentheses after the name
    std::string description, source;
    std::vector<AfferentParameter> parameters;
    std::vector<std::string> other_names;
    std::string_view detail_key = "composition";  ///< the JSON key of `detail` for this kind of entry
    std::vector<CatalogNote> notes = {};
};

inline ListEntry list_entry(std::string_view name, std::string_view detail, std::string_view description, std::string_view source = {}) {
    return {std::string(name), std::string(detail), std::string(description), std::string(source), {}, {}};
}

struct ListSection {
    std::string_view name;
    std::vector<ListEntry> entries;
};

/// The sections "skins" (populations) and "contact" (indenters and touches).
std::vector<ListSection> skin_sections();

/// The sites of one population, in the order of the forces in a frame, as CSV or JSON. Returns an error unless `populations` has one entry.
/// The CSV can be used as the site list of a population file.
Result<std::string> sites_listing(const std::vector<std::string>& populations, bool json);

}  // namespace corpuscle
