#include "core/text/option.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {
namespace {

/// The long name of an option, without dashes: "channel" of "--channel,-c".
std::string_view plain_name(const OptionRow& row) {
    const auto first = row.names.substr(0, row.names.find(','));
    return first.substr(std::min(first.find_first_not_of('-'), first.size()));
}

/// True for a flag "--no-x".
bool is_negation(const OptionRow& row) { return row.names.starts_with("--no-"); }

/// True for an option without a value.
bool is_flag(const OptionRow& row) {
    if (std::holds_alternative<OptionReader>(row.target)) return row.value.empty();
    return std::holds_alternative<bool*>(row.target) || std::holds_alternative<std::optional<bool>*>(row.target);
}

/// True for an option that may be given several times.
bool may_repeat(const OptionRow& row) {
    return row.is_repeatable || is_flag(row) || std::holds_alternative<std::vector<std::string>*>(row.target) ||
           std::holds_alternative<std::vector<double>*>(row.target);
}

bool excludes(const OptionRow& a, const OptionRow& b) { return a.excludes && b.names.substr(0, b.names.find(',')) == a.excludes; }

Result<void> check_value(const OptionRow& row, const std::string& text) {
    if (const auto* choices = std::get_if<std::vector<std::string>>(&row.check))
        if (std::find(choices->begin(), choices->end(), text) == choices->end())
            return bad_usage(fmt::format("{} = {}: write one of {}", plain_name(row), text, fmt::join(*choices, ", ")));
    return {};
}

Result<bool> parse_flag(const OptionRow& row, const std::string& text) {
    if (text == "true" || text == "false") return text == "true";
    return bad_usage(fmt::format("{} = {}: write true or false", plain_name(row), text));
}

/// A whole number within the row's range.
Result<std::int64_t> parse_integer(const OptionRow& row, const std::string& text) {
    const auto value = parse_quantity(text, "");
    std::pair<double, double> range = {-9e15, 9e15};
    if (const auto* r = std::get_if<std::pair<int, int>>(&row.check)) range = {r->first, r->second};
    if (const auto* r = std::get_if<std::pair<std::uint32_t, std::uint32_t>>(&row.check)) range = {r->first, r->second};
    if (!value || *value != static_cast<double>(static_cast<std::int64_t>(*value)) || *value < range.first || *value > range.second)
        return bad_usage(fmt::format("{} = {}: write an integer from {:.0f} to {:.0f}", plain_name(row), text, range.first, range.second));
    return static_cast<std::int64_t>(*value);
}

/// Sets a target of one type.
struct Setter {
    const OptionRow& row;
    const std::string& text;

    Result<void> operator()(const OptionReader& read) const {
        if (row.value.empty()) return TRY(parse_flag(row, text)) ? read("") : Result<void>();
        if (std::holds_alternative<std::pair<std::uint32_t, std::uint32_t>>(row.check)) TRY(parse_integer(row, text));
        const auto ok = read(text);
        return ok ? Result<void>() : bad_usage(fmt::format("{} = {}", plain_name(row), ok.error().message));
    }
    Result<void> operator()(std::string* to) const { return *to = text, Result<void>(); }
    Result<void> operator()(std::optional<std::string>* to) const { return *to = text, Result<void>(); }
    Result<void> operator()(std::vector<std::string>* to) const { return to->push_back(text), Result<void>(); }
    Result<void> operator()(std::vector<double>* to) const {
        const auto value = parse_quantity(text, "");
        return value ? (to->push_back(*value), Result<void>()) : value.error();
    }
    Result<void> operator()(bool* to) const { return *to = TRY(parse_flag(row, text)), Result<void>(); }
    Result<void> operator()(std::optional<bool>* to) const {
        const bool value = TRY(parse_flag(row, text));
        if (!is_negation(row))
            *to = value;
        else if (value)
            *to = false;
        return {};
    }
    template <class T>
    Result<void> operator()(T* to) const {
        if constexpr (requires { to->value(); })
            *to = static_cast<typename T::value_type>(TRY(parse_integer(row, text)));
        else
            *to = static_cast<T>(TRY(parse_integer(row, text)));
        return {};
    }
};

}  // namespace

OptionReader refuse_if(std::function<bool()> is_invalid, std::string_view message, OptionReader read) {
    return [=](const std::string& text) -> Result<void> {
        TRY(read(text));
        return is_invalid() ? bad_usage(fmt::format("{}: {}", text, message)) : Result<void>();
    };
}

OptionReader override_reader(std::vector<ParameterOverride>& to, std::string option) {
    return list_reader(to, [option = std::move(option)](const std::string& text) { return parse_override(text, option); });
}

Result<void> NamedOptions::check_given(const OptionRow& row) const {
    for (const auto* other : given_) {
        if (other == &row && !may_repeat(row)) return bad_usage(fmt::format("{} is given twice; give it once", plain_name(row)));
        if (excludes(row, *other) || excludes(*other, row))
            return bad_usage(fmt::format("{} and {} exclude each other; give one of them", plain_name(*other), plain_name(row)));
    }
    return {};
}

Result<void> NamedOptions::set(std::string_view name, const std::string& text) {
    const auto& rows = group_.rows;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const OptionRow& r) { return plain_name(r) == name; });
    if (row == rows.end()) {
        std::vector<std::string_view> known;
        for (const auto& r : rows) known.push_back(plain_name(r));
        return bad_usage(fmt::format("unknown option {}; there are {}", name, fmt::join(known, ", ")));
    }
    TRY(check_value(*row, text));
    TRY(std::visit(Setter{*row, text}, row->target));
    if (is_flag(*row) && text == "false") return {};  // not given
    TRY(check_given(*row));
    given_.push_back(&*row);
    return {};
}

}  // namespace corpuscle
