#pragma once
// The sections and entries that `corpuscle list` prints.

#include <string>
#include <vector>

#include "model/catalog.hpp"

namespace corpuscle {

/// A property of an entry other than a parameter: its name, its text, and the source of its value.
struct CatalogNote {
    std::string of, text, source;
};

struct Entry {
    std::string name, made_of, sentence, source;
    std::vector<AfferentParameter> parameters;
    std::vector<std::string> other_names;
    std::string_view made_of_is = "made_of";  ///< the JSON key of made_of for this kind of entry
    std::vector<CatalogNote> told = {};
};

struct Section {
    std::string_view name;
    std::vector<Entry> entries;
};

/// Skin populations, and indenters.
std::vector<Section> skin_sections();

/// The sites of one population in frame order. The CSV form can be used as the site list of a population file.
Result<std::string> sites_listing(const std::vector<std::string>& populations, bool json);

}  // namespace corpuscle
