#include "signal/settings.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

std::string names_of(std::span<const Row> parameters) {
    std::string names;
    for (const auto& r : parameters) names += (names.empty() ? "" : ", ") + std::string(r.name);
    return names;
}

std::string unknown_parameter(const Wish& w, std::span<const Row> parameters) {
    std::vector<std::string_view> names;
    for (const auto& r : parameters) names.push_back(r.name);
    return fmt::format("{}: unknown parameter '{}'{} (it has {})", w.of, w.parameter, did_you_mean(w.parameter, names),
                       names_of(parameters));
}

}  // namespace

Result<Wish> parse_wish(std::string_view text) {
    const auto equals = text.find('=');
    const auto dot = text.substr(0, equals).rfind('.');
    if (equals == std::string_view::npos || dot == std::string_view::npos || dot == 0 || dot + 1 == equals || equals + 1 == text.size())
        return bad_usage(fmt::format("'{}' is not a setting; write NAME.PARAMETER=VALUE, such as 'sa1.f_B=25Hz'", text));
    return Wish{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1, equals - dot - 1)),
                std::string(text.substr(equals + 1))};
}

Result<const Row*> row_for(const Wish& w, std::span<const Row> parameters) {
    const auto parameter = std::find_if(parameters.begin(), parameters.end(), [&](const Row& r) { return r.name == w.parameter; });
    if (parameter == parameters.end()) return bad_input(unknown_parameter(w, parameters));
    return &*parameter;
}

Result<std::vector<Setting>> settings_for(std::string_view name, std::span<const Row> parameters, std::span<const Wish> overrides) {
    std::vector<Setting> settings;
    for (const auto& w : overrides) {
        if (w.of != name) continue;
        w.used = true;
        const auto parameter = row_for(w, parameters);
        if (!parameter) return parameter.error();
        const auto value = parse_quantity(w.value, (*parameter)->unit);
        if (!value) return bad_input(fmt::format("{}.{}: {}", w.of, w.parameter, value.error().sentence));
        if (const auto wrong = outside(name, **parameter, *value)) return *wrong;
        settings.push_back({(*parameter)->name, *value});
    }
    return settings;
}

}  // namespace corpuscle
