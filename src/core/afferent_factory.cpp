#include "core/afferent_factory.hpp"

#include <nlohmann/json.hpp>

namespace corpuscle {

Result<std::shared_ptr<const AfferentFactory>> AfferentFactory::rebuilt(const AfferentPlan&, const AfferentPlan&) const {
    return std::shared_ptr<const AfferentFactory>();
}

nlohmann::ordered_json AfferentFactory::cost(double, const EnergyUse&) const { return nullptr; }

std::optional<double> AfferentPlan::value(std::string_view parameter) const {
    for (std::size_t k = 0; k < values.size(); ++k)
        if ((*parameters)[k].info.name == parameter) return values[k];
    return {};
}

std::vector<ParameterInfo> parameter_infos(const AfferentPlan& plan) {
    std::vector<ParameterInfo> out;
    for (const auto& p : *plan.parameters) out.push_back(p.info);
    return out;
}

void set_values(AfferentPlan& plan, std::span<const Setting> settings) {
    for (const auto& s : settings)
        for (std::size_t k = 0; k < plan.values.size(); ++k)
            if ((*plan.parameters)[k].info.name == s.name) plan.values[k] = s.value;
}

Result<std::string> AfferentFactory::schematic(std::string_view) const {
    return bad_input("an afferent of equations has no schematic; a circuit, such as sa1-circuit, has one");
}

}  // namespace corpuscle
