#include "signal/settings.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

std::string one_of(std::span<const Row> rows) {
    std::string names;
    for (const auto& r : rows) names += (names.empty() ? "" : ", ") + std::string(r.name);
    return names;
}

std::string unknown_parameter(const Wish& w, std::span<const Row> rows) {
    std::vector<std::string_view> names;
    for (const auto& r : rows) names.push_back(r.name);
    return fmt::format("{}: unknown parameter '{}'{} (it has {})", w.of, w.parameter, did_you_mean(w.parameter, names), one_of(rows));
}

}  // namespace

Result<Wish> parse_wish(std::string_view text) {
    const auto equals = text.find('=');
    const auto dot = text.substr(0, equals).rfind('.');
    if (equals == std::string_view::npos || dot == std::string_view::npos || dot == 0 || dot + 1 == equals || equals + 1 == text.size())
        return bad_usage(fmt::format("'{}' is no setting; write NAME.PARAMETER=VALUE, such as 'sa1.f_B=25Hz'", text));
    return Wish{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1, equals - dot - 1)),
                std::string(text.substr(equals + 1))};
}

Result<const Row*> row_for(const Wish& w, std::span<const Row> rows) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == w.parameter; });
    if (row == rows.end()) return bad_input(unknown_parameter(w, rows));
    return &*row;
}

Result<std::vector<Setting>> settings_for(std::string_view name, std::span<const Row> rows, std::span<const Wish> wishes) {
    std::vector<Setting> settings;
    for (const auto& w : wishes) {
        if (w.of != name) continue;
        w.used = true;
        const auto row = row_for(w, rows);
        if (!row) return row.error();
        const auto value = parse_quantity(w.value, (*row)->unit);
        if (!value) return bad_input(fmt::format("{}.{}: {}", w.of, w.parameter, value.error().sentence));
        if (const auto wrong = outside(name, **row, *value)) return *wrong;
        settings.push_back({(*row)->name, *value});
    }
    return settings;
}

}  // namespace corpuscle
