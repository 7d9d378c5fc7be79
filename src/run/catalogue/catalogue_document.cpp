#include "run/catalogue/catalogue_document.hpp"

#include <limits>
#include <nlohmann/json.hpp>

namespace corpuscle {

using Json = nlohmann::ordered_json;

bool has_range(const ParameterInfo& r) {
    return r.low > -std::numeric_limits<double>::max() || r.high < std::numeric_limits<double>::max();
}

Json document_of(const AfferentParameter& p) {
    return {{"name", p.info.name},
            {"default", p.info.default_value},
            {"unit", p.info.unit},
            {"low", has_range(p.info) ? Json(p.info.low) : Json(nullptr)},
            {"high", has_range(p.info) ? Json(p.info.high) : Json(nullptr)},
            {"description", p.info.description},
            {"source", p.info.source},
            {"component", p.component}};
}

Json document_of(const ListEntry& e) {
    Json out = {{"name", e.name}, {"description", e.description}};
    if (!e.detail.empty()) out[std::string(e.detail_key)] = e.detail;
    if (!e.source.empty()) out["source"] = e.source;
    if (!e.other_names.empty()) out["also_called"] = e.other_names;
    for (const auto& p : e.parameters) out["parameters"].push_back(document_of(p));
    for (const auto& t : e.notes) out["notes"].push_back({{"subject", t.subject}, {"text", t.text}, {"source", t.source}});
    return out;
}

}  // namespace corpuscle
