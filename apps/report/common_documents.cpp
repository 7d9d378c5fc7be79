#include "report/common_documents.hpp"

#include <nlohmann/json.hpp>

namespace corpuscle {

using PartJson = nlohmann::ordered_json;

PartJson curve_document(std::uint32_t channel, const PartJson& afferent, std::string_view quantity, std::string_view unit,
                        const Envelope& values) {
    return {{"channel", channel},
            {"afferent", afferent},
            {"quantity", quantity},
            {"unit", unit},
            {"bucket", values.bucket()},
            {"count", values.count()},
            {"data", base64(values.values().data(), values.values().size() * sizeof(float))}};
}

PartJson parameters_document(const AfferentPlan& plan, std::span<const ParameterDistribution> spreads) {
    PartJson out = PartJson::array();
    for (std::size_t k = 0; k < plan.values.size(); ++k) {
        const auto& p = (*plan.parameters)[k];
        out.push_back({{"name", p.info.name},
                       {"value", plan.values[k]},
                       {"unit", p.info.unit},
                       {"default", p.info.default_value},
                       {"set", p.set_by_user},
                       {"description", p.info.description},
                       {"source", p.info.source},
                       {"component", p.component}});
        for (const auto& s : spreads)
            if (s.afferent == plan.name && s.parameter == p.info.name) out.back()["spread"] = s.deviation;
    }
    return out;
}

}  // namespace corpuscle
