#include "skin/plan/class_overrides.hpp"

#include <fmt/format.h>

namespace corpuscle {

Result<void> apply_class_overrides(SkinPlan& plan, std::span<const ParameterOverride> overrides) {
    for (auto& c : plan.classes) {
        std::vector<ParameterInfo> rows;
        for (const auto& p : *c.afferent.parameters) rows.push_back(p.info);
        const auto settings = settings_for(c.name, rows, overrides);
        if (!settings) return settings.error();
        for (const auto& s : *settings)
            for (std::size_t k = 0; k < rows.size(); ++k)
                if (rows[k].name == s.name) c.afferent.values[k] = s.value;
        if (auto ok = check_plan(c.afferent); !ok) return ok.error();
    }
    return {};
}

Result<void> check_overrides_used(const SkinPlan& plan, std::span<const ParameterOverride> overrides,
                                  std::span<const std::string_view> others) {
    std::vector<std::string_view> names(others.begin(), others.end());
    for (const auto& c : plan.classes) names.push_back(c.name);
    for (const auto& o : overrides)
        if (!o.is_used)
            return bad_usage(fmt::format("{}: unknown name '{}'{} (parameters of {} can be set)", o.text(), o.target,
                                         did_you_mean(o.target, names), fmt::join(names, ", ")));
    return {};
}

}  // namespace corpuscle
