#include "page/catalogue_answer.hpp"

#include "core/version.hpp"
#include "page/documents.hpp"
#include "run/afferent_plan.hpp"
#include "run/catalogue/catalogue_document.hpp"
#include "skin/contact/indenters.hpp"
#include "skin/innervation.hpp"

namespace corpuscle::page {
namespace {

/// The named afferents of the catalogue, with what a plan and its afferent tell.
Result<Json> afferents_document(const Json& entries) {
    auto out = Json::array();
    for (const auto& entry : entries) {
        const auto name = entry["name"].get<std::string>();
        if (name.find('/') != name.npos) continue;  // an entry that stands for files
        const auto plan = TRY(plan_any_afferent(name)).result;
        const auto afferent = make_afferent(plan, {});
        auto row = document_of(plan);
        row["description"] = entry["description"];
        row["probes"] = document_of(afferent->probes());
        row["ranges"] = document_of(afferent->ranges());
        out.push_back(std::move(row));
    }
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
    for (const auto& indenter : indenters) {
        Json row = {{"name", indenter.name}, {"description", indenter.description}, {"parameters", Json::array()}};
        for (const auto parameter : indenter.parameters)
            if (!parameter.empty()) row["parameters"].push_back(parameter);
        out.push_back(std::move(row));
    }
    return out;
}

}  // namespace

Result<void> describe_catalogue(MessageWriter& answer) {
    answer.head["version"] = version;
    auto& sections = answer.head["sections"] = Json::object();
    for (const auto& section : catalogue_sections())
        for (const auto& entry : section.entries()) sections[std::string(section.name)].push_back(corpuscle::document_of(entry));
    auto afferents = TRY(afferents_document(sections["afferents"]));
    answer.head["afferents"] = std::move(afferents);
    answer.head["populations"] = populations_document();
    answer.head["indenters"] = indenters_document();
    return {};
}

}  // namespace corpuscle::page
