#include "cli/arguments/option_rows.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <type_traits>

namespace corpuscle {
namespace {

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

/// True for a default that --help prints: a text or a number that the check does not refuse.
template <class T>
bool has_visible_default(const T& value, const OptionCheck& check) {
    if constexpr (std::is_same_v<T, std::uint32_t>)
        if (const auto* range = std::get_if<std::pair<std::uint32_t, std::uint32_t>>(&check)) return value >= range->first;
    return std::is_same_v<T, std::string> || std::is_arithmetic_v<T>;
}

/// Adds an option whose text, or texts if it is repeatable, a function reads. Without a placeholder it is a flag.
CLI::Option* add_read_option(CLI::App& part, const OptionRow& row, const OptionReader& reader) {
    const std::string names(row.names), option = names.substr(0, names.find(',')), description(row.description);
    const auto read = [reader, option](const std::string& text) {
        if (const auto ok = reader(text); !ok)
            throw OptionError(ok.error().code == ErrorCode::bad_usage ? bad_usage(fmt::format("{} {}", option, ok.error().message))
                                                                      : ok.error());
    };
    const auto read_all = [read](const std::vector<std::string>& texts) {
        for (const auto& text : texts) read(text);
    };
    if (row.value.empty()) return part.add_flag_callback(names, [read] { read(""); }, description);
    auto* const added = row.is_repeatable ? part.add_option_function<std::vector<std::string>>(names, read_all, description)
                                          : part.add_option_function<std::string>(names, read, description);
    if (row.is_repeatable && names.starts_with('-')) added->allow_extra_args(false);
    if (row.splits_at_commas) added->delimiter(',');
    return row.shown_default ? added->default_str(row.shown_default) : added;
}

/// Adds the option of a row without the properties that do not depend on the type of its target.
CLI::Option* add_option(CLI::App& part, const OptionRow& row) {
    const auto add = [&]<class Target>(const Target& target) -> CLI::Option* {
        using T = std::remove_pointer_t<Target>;
        const std::string names(row.names), description(row.description);
        if constexpr (std::is_same_v<T, OptionReader>) {
            return add_read_option(part, row, target);
        } else if constexpr (std::is_same_v<T, bool>) {
            return part.add_flag(names, *target, description);
        } else if constexpr (std::is_same_v<T, std::optional<bool>>) {
            const bool value = !names.starts_with("--no-");
            return part.add_flag_callback(names, [target, value] { *target = value; }, description);
        } else {
            auto* const option = part.add_option(names, *target, description);
            if (has_visible_default(*target, row.check)) option->capture_default_str();
            if constexpr (is_list<T>)
                if (names.starts_with('-')) option->allow_extra_args(row.count.has_value());
            return option;
        }
    };
    return std::visit(add, row.target);
}

CLI::Validator validator_of(const OptionCheck& check) {
    if (const auto* choices = std::get_if<std::vector<std::string>>(&check)) return CLI::IsMember(*choices);
    if (const auto* range = std::get_if<std::pair<int, int>>(&check)) return CLI::Range(range->first, range->second);
    if (const auto* range = std::get_if<std::pair<std::uint32_t, std::uint32_t>>(&check)) return CLI::Range(range->first, range->second);
    return std::get<OptionSign>(check) == OptionSign::positive ? CLI::Validator(CLI::PositiveNumber)
                                                               : CLI::Validator(CLI::NonNegativeNumber);
}

}  // namespace

void add_options(CLI::App& part, const OptionGroup& group) {
    for (const auto& row : group.rows) {
        auto& option = *add_option(part, row);
        if (!row.value.empty()) option.type_name(std::string(row.value));
        if (!group.title.empty()) option.group(group.title);
        if (row.check.index() != 0) option.check(validator_of(row.check));
        if (row.count) option.expected(row.count->first, row.count->second);
        option.required(row.is_required);
        if (row.excludes) option.excludes(part.get_option(row.excludes));
    }
}

}  // namespace corpuscle
