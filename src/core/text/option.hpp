#pragma once
// Options as rows of a table: those of the verbs, in the order of --help, and the same from a program that names them.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/parameter_override.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {

/// Reads the text of an option into a typed value. The message of an error of usage follows the name of the option.
using OptionReader = std::function<Result<void>(const std::string& text)>;

/// The variable that an option sets, or the function that reads it. The value of a list is that of all occurrences of the option; a bool is
/// a flag, and the flag "--no-x" sets an optional bool to false. With a reader the option is a flag if it has no placeholder.
using OptionTarget = std::variant<bool*, std::string*, int*, std::int64_t*, std::uint32_t*, std::uint64_t*, std::optional<bool>*,
                                  std::optional<std::string>*, std::optional<std::int64_t>*, std::optional<std::uint32_t>*,
                                  std::optional<std::uint64_t>*, std::vector<std::string>*, std::vector<double>*, OptionReader>;

enum class OptionSign { not_negative, positive };

/// The values that an option accepts: any, one of several texts, a range of integers, or numbers of a sign.
using OptionCheck =
    std::variant<std::monostate, std::vector<std::string>, std::pair<int, int>, std::pair<std::uint32_t, std::uint32_t>, OptionSign>;

template <class... T>
std::vector<std::string> one_of(T... texts) {
    return {texts...};
}

inline constexpr int any_number_of_values = -1;

/// An option ("--out,-o") or a positional argument ("FILE").
struct OptionRow {
    std::string_view names;
    OptionTarget target;     ///< its value before parsing is the default, which --help prints unless `check` refuses it
    std::string_view value;  ///< the placeholder of the value in --help: "FILE"; "" for flags, and for the name of its type
    std::string_view description;
    OptionCheck check = {};
    /// The numbers of values per occurrence, lowest and highest. Default: one, and any number for a positional list.
    std::optional<std::pair<int, int>> count = {};
    bool is_required = false;
    bool is_repeatable = false;           ///< with a reader: may be given several times
    bool splits_at_commas = false;        ///< with a reader: each part of a value is read
    const char* shown_default = nullptr;  ///< with a reader: the default that --help prints
    const char* excludes = nullptr;       ///< an option that must not be given, too
    /// Values that a shell offers for this option, beside those of `check`; it may have others. Null: none.
    std::vector<std::string> (*suggestions)() = nullptr;
};

/// A row with a further property; the properties are those of the members.
inline OptionRow required(OptionRow row) { return row.is_required = true, row; }
inline OptionRow counted(int lowest, int highest, OptionRow row) { return row.count = {lowest, highest}, row; }
inline OptionRow excluding(const char* option, OptionRow row) { return row.excludes = option, row; }
inline OptionRow repeatable(OptionRow row) { return row.is_repeatable = true, row; }
inline OptionRow suggesting(std::vector<std::string> (*values)(), OptionRow row) { return row.suggestions = values, row; }
inline OptionRow with_default(const char* text, OptionRow row) { return row.shown_default = text, row; }
inline OptionRow split_at_commas(OptionRow row) { return row.is_repeatable = row.splits_at_commas = true, row; }

/// Reads a value into a variable. `read` turns the text into the value or an error.
template <class T, class Read>
OptionReader value_reader(T& to, Read read) {
    return [&to, read](const std::string& text) -> Result<void> {
        auto value = read(text);
        if (!value) return value.error();
        return to = std::move(*value), Result<void>();
    };
}
/// Reads a quantity, in SI. `unit`: as for parse_quantity().
inline auto quantity_of(std::string_view unit) {
    return [unit](const std::string& text) -> Result<double> {
        auto value = parse_quantity(text, unit);
        return value ? std::move(value) : bad_usage(value.error().message);
    };
}
template <class T>
OptionReader quantity_reader(T& to, std::string_view unit) {
    return value_reader(to, quantity_of(unit));
}
/// A reader that refuses a text after reading it if `is_invalid()`: "TEXT: MESSAGE".
OptionReader refuse_if(std::function<bool()> is_invalid, std::string_view message, OptionReader);
/// A quantity above 0.
inline OptionReader above_zero_reader(double& to, std::string_view unit) {
    return refuse_if([&to] { return !(to > 0); }, "must be greater than 0", quantity_reader(to, unit));
}
/// Reads texts into a list. `read` turns a text into an element of the list or an error.
template <class T, class Read>
OptionReader list_reader(std::vector<T>& to, Read read) {
    return [&to, read](const std::string& text) -> Result<void> {
        Result<T> value = read(text);
        if (!value) return value.error();
        return to.push_back(std::move(*value)), Result<void>();
    };
}
/// Reads settings ("sa1.f_B=25Hz") of this option into a list.
OptionReader override_reader(std::vector<ParameterOverride>&, std::string option);

/// A group of options. The title "" is that of the options without a title.
struct OptionGroup {
    std::string title;
    std::vector<OptionRow> rows;
};

/// The options of a group as a program gives them, by name and text. The same are refused as on the command line: an option that is given
/// twice but is not repeatable, and one that excludes another.
class NamedOptions {
    OptionGroup group_;
    std::vector<const OptionRow*> given_;

    Result<void> check_given(const OptionRow&) const;

public:
    explicit NamedOptions(OptionGroup group) : group_(std::move(group)) {}
    NamedOptions(const NamedOptions&) = delete;
    NamedOptions& operator=(const NamedOptions&) = delete;

    /// Sets the option of this name, such as "lowpass" for --lowpass, from its text. A flag accepts "true", and "false", with which a flag
    /// "no-x" is as if it were not given. Errors name the option, and one that does not exist lists the names that do.
    Result<void> set(std::string_view name, const std::string& text);
};

}  // namespace corpuscle
