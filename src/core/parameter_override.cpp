#include "core/parameter_override.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

std::string names_of(std::span<const ParameterInfo> parameters) {
    std::string names;
    for (const auto& r : parameters) names += (names.empty() ? "" : ", ") + std::string(r.name);
    return names;
}

std::string unknown_parameter(const ParameterOverride& given, std::span<const ParameterInfo> parameters) {
    std::vector<std::string_view> names;
    for (const auto& r : parameters) names.push_back(r.name);
    return fmt::format("{}: unknown parameter '{}'{} (it has {})", given.target, given.parameter, did_you_mean(given.parameter, names),
                       names_of(parameters));
}

}  // namespace

Result<ParameterOverride> parse_override(std::string_view text) {
    const auto equals = text.find('=');
    const auto dot = text.substr(0, equals).rfind('.');
    if (equals == std::string_view::npos || dot == std::string_view::npos || dot == 0 || dot + 1 == equals || equals + 1 == text.size())
        return bad_usage(fmt::format("'{}' is not a setting; write NAME.PARAMETER=VALUE, such as 'sa1.f_B=25Hz'", text));
    return ParameterOverride{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1, equals - dot - 1)),
                             std::string(text.substr(equals + 1))};
}

Result<const ParameterInfo*> find_parameter(const ParameterOverride& given, std::span<const ParameterInfo> parameters) {
    const auto parameter =
        std::find_if(parameters.begin(), parameters.end(), [&](const ParameterInfo& r) { return r.name == given.parameter; });
    if (parameter == parameters.end()) return bad_input(unknown_parameter(given, parameters));
    return &*parameter;
}

Result<std::vector<Setting>> settings_for(std::string_view name, std::span<const ParameterInfo> parameters,
                                          std::span<const ParameterOverride> overrides) {
    std::vector<Setting> settings;
    for (const auto& given : overrides) {
        if (given.target != name) continue;
        given.is_used = true;
        const auto parameter = find_parameter(given, parameters);
        if (!parameter) return parameter.error();
        const auto value = parse_quantity(given.value, (*parameter)->unit);
        if (!value) return bad_input(fmt::format("{}.{}: {}", given.target, given.parameter, value.error().message));
        if (const auto ok = check_range(name, **parameter, *value); !ok) return ok.error();
        settings.push_back({(*parameter)->name, *value});
    }
    return settings;
}

}  // namespace corpuscle
