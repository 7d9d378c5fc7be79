#include "corpuscle/catalogue.hpp"

#include <limits>

#include "api/result.hpp"
#include "core/text/ascii_text.hpp"
#include "run/catalogue/catalogue_sections.hpp"

namespace corpuscle {
namespace {

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

CatalogueEntry public_entry(const ListEntry& e) {
    CatalogueEntry out{e.name, e.detail, e.description, e.source, {}};
    for (const auto& p : e.parameters) out.parameters.push_back(parameter(p.info, e.source));
    return out;
}

}  // namespace

std::vector<std::string> catalogues() {
    std::vector<std::string> out;
    for (const auto& section : catalogue_sections()) out.emplace_back(section.name);
    return out;
}

std::vector<CatalogueEntry> catalogue(const std::string& name) {
    std::vector<std::string_view> known;
    for (const auto& section : catalogue_sections()) {
        known.push_back(section.name);
        if (section.name != name) continue;
        std::vector<CatalogueEntry> out;
        for (const auto& e : section.entries())
            if (!e.is_pattern) out.push_back(public_entry(e));
        return out;
    }
    throw InputError("there is no catalogue '" + name + "'" + did_you_mean(name, known));
}

}  // namespace corpuscle
