#pragma once
// What `corpuscle list` shows: sections of entries.

#include <string>
#include <vector>

#include "model/catalog.hpp"

namespace corpuscle {

/// Something told of an entry that is no parameter.
struct CatalogNote {
    std::string of, text, source;
};

struct Entry {
    std::string name, made_of, sentence, source;
    std::vector<Parameter> parameters;
    std::vector<std::string> other_names;
    std::string_view made_of_is = "made_of";  ///< what made_of is of this kind of entry, in JSON
    std::vector<CatalogNote> told = {};
};

struct Section {
    std::string_view name;
    std::vector<Entry> entries;
};

/// Populations, and what can press on them.
std::vector<Section> skin_sections();

/// The sites of one population, in the order that frames have them: CSV that a population file takes as its list, or JSON.
Result<std::string> sites_listing(const std::vector<std::string>& populations, bool json);

}  // namespace corpuscle
