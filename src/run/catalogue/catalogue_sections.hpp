#pragma once
// The catalogues that `corpuscle list` prints, and that the public interface returns.

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
    bool is_pattern = false;         ///< it stands for many things, as "path/own.cir" does
    bool is_implementation = false;  ///< of an afferent, see its traits
};

inline ListEntry list_entry(std::string_view name, std::string_view detail, std::string_view description, std::string_view source = {}) {
    return {std::string(name), std::string(detail), std::string(description), std::string(source), {}, {}};
}

/// An entry that stands for many things.
inline ListEntry list_pattern(std::string_view name, std::string_view detail, std::string_view description, std::string_view source = {}) {
    auto out = list_entry(name, detail, description, source);
    out.is_pattern = true;
    return out;
}

/// A catalogue. Its entries are made when they are asked for, because some take milliseconds.
struct CatalogueSection {
    std::string_view name;
    std::vector<ListEntry> (*entries)();
};

/// All catalogues, in the order in which they are listed.
std::span<const CatalogueSection> catalogue_sections();

std::vector<ListEntry> skin_entries();     ///< populations
std::vector<ListEntry> contact_entries();  ///< indenters and touches

}  // namespace corpuscle
