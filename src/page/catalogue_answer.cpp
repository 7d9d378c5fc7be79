#include "page/catalogue_answer.hpp"

#include <span>

#include "core/version.hpp"
#include "run/catalogue/catalogue_document.hpp"
#include "run/compare/implementation_comparison.hpp"
#include "skin/contact/indenters.hpp"
#include "skin/innervation.hpp"

namespace corpuscle::page {
namespace {

/// The named afferents of the catalogue.
Json afferents_document(std::span<const ListEntry> entries) {
    auto out = Json::array();
    for (const auto& entry : entries)
        if (!entry.is_pattern)
            out.push_back({{"name", entry.name},
                           {"class", afferent_type_of(entry.name)},
                           {"composition", entry.detail},
                           {"is_circuit", entry.is_implementation},
                           {"description", entry.description}});
    return out;
}

Json populations_document() {
    auto out = Json::array();
    for (const auto& named : named_skins()) {
        std::uint64_t afferents = 0;
        if (const auto plan = load_skin_plan(named.name))
            for (std::uint32_t c = 0; c < plan->classes.size(); ++c)
                for (const auto count : afferents_by_region(*plan, c)) afferents += count;
        out.push_back({{"name", named.name}, {"description", named.description}, {"afferents", afferents}});
    }
    return out;
}

Json indenters_document() {
    auto out = Json::array();
    for (const auto& indenter : indenters) out.push_back({{"name", indenter.name}, {"description", indenter.description}});
    return out;
}

}  // namespace

void describe_catalogue(MessageWriter& answer) {
    answer.head["version"] = version;
    auto sections = Json::object();
    for (const auto& section : catalogue_sections()) {
        const auto entries = section.entries();
        for (const auto& entry : entries) sections[std::string(section.name)].push_back(corpuscle::document_of(entry));
        if (section.name == "afferents") answer.head["afferents"] = afferents_document(entries);
    }
    answer.head["sections"] = std::move(sections);
    answer.head["populations"] = populations_document();
    answer.head["indenters"] = indenters_document();
}

}  // namespace corpuscle::page
