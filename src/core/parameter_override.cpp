#include "core/parameter_override.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <tuple>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

std::string unknown_parameter(const ParameterOverride& given, std::span<const ParameterInfo> parameters) {
    std::vector<std::string_view> names;
    for (const auto& r : parameters) names.push_back(r.name);
    return fmt::format("{}: unknown parameter '{}'{} (it has {})", given.target, given.parameter, did_you_mean(given.parameter, names),
                       joined(names));
}

}  // namespace

bool ParameterOverride::operator==(const ParameterOverride& other) const {
    const auto all = [](const ParameterOverride& o) {
        return std::tie(o.target, o.parameter, o.value, o.typed, o.location.file, o.location.line, o.location.column);
    };
    return all(*this) == all(other);
}

Result<ParameterOverride> parse_override(std::string_view text, std::string_view option) {
    const auto equals = text.find('=');
    const auto dot = text.substr(0, equals).rfind('.');
    if (equals == std::string_view::npos || dot == std::string_view::npos || dot == 0 || dot + 1 == equals || equals + 1 == text.size())
        return bad_usage(fmt::format("'{}' is not a setting; write NAME.PARAMETER=VALUE, such as 'sa1.f_B=25Hz'", text));
    return ParameterOverride{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1, equals - dot - 1)),
                             std::string(text.substr(equals + 1)), fmt::format("{}{}{}", option, option.empty() ? "" : " ", text)};
}

Result<std::vector<ParameterOverride>> parse_overrides(std::span<const std::string> texts, std::string_view option) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : texts) overrides.push_back(TRY(parse_override(text, option)));
    return overrides;
}

Result<const ParameterInfo*> find_parameter(const ParameterOverride& given, std::span<const ParameterInfo> parameters) {
    const auto parameter =
        std::find_if(parameters.begin(), parameters.end(), [&](const ParameterInfo& r) { return r.name == given.parameter; });
    if (parameter == parameters.end()) return bad_input(unknown_parameter(given, parameters), given.location);
    return &*parameter;
}

Applied<std::vector<ParameterOverride>> select_overrides(std::span<const ParameterOverride> overrides, const IsTarget& is_target) {
    Applied<std::vector<ParameterOverride>> out;
    for (const auto& given : overrides) (is_target(given.target) ? out.result : out.unused).push_back(given);
    return out;
}

Result<Setting> setting_of(const ParameterOverride& given, std::span<const ParameterInfo> parameters) {
    const auto parameter = TRY(find_parameter(given, parameters));
    const auto value = parse_quantity(given.value, parameter->unit);
    if (!value) return bad_input(fmt::format("{}: {}", given.name(), value.error().message), given.location);
    if (const auto ok = check_range(given.target, *parameter, *value); !ok) return bad_input(ok.error().message, given.location);
    return Setting{parameter->name, *value};
}

Result<Applied<std::vector<Setting>>> settings_for(std::string_view name, std::span<const ParameterInfo> parameters,
                                                   std::span<const ParameterOverride> overrides) {
    auto [own, unused] = select_overrides(overrides, [&](std::string_view target) { return target == name; });
    std::vector<Setting> settings;
    for (const auto& given : own) settings.push_back(TRY(setting_of(given, parameters)));
    return Applied<std::vector<Setting>>{std::move(settings), std::move(unused)};
}

void keep_unused(std::vector<ParameterOverride>& unused, std::span<const ParameterOverride> still_unused) {
    std::erase_if(unused, [&](const ParameterOverride& given) {
        return std::find(still_unused.begin(), still_unused.end(), given) == still_unused.end();
    });
}

Result<void> check_all_used(std::span<const ParameterOverride> unused, std::span<const std::string_view> targets) {
    if (unused.empty()) return {};
    const auto& given = unused.front();
    if (given.target.empty()) return bad_usage(fmt::format("{}: there is no netlist in this run; try --afferent sa1-circuit", given.typed));
    return Error{given.location.line > 0 ? ErrorCode::bad_input : ErrorCode::bad_usage,
                 fmt::format("{}: nothing here is named '{}'{} (parameters of {} can be set)", given.typed, given.target,
                             did_you_mean(given.target, targets), joined(targets)),
                 given.location};
}

}  // namespace corpuscle
