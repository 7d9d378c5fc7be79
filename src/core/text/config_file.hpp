#pragma once
// Configuration files: sweeps, populations and studies, in TOML. A file is read into nodes that know their location, so that every later
// error can name it. Only config_file.cpp includes toml++, which is slow to compile.

#include "core/parameter_override.hpp"

namespace corpuscle {

/// A value of a configuration file before it is parsed: its text and its location in the file.
struct LocatedText {
    std::string text;
    SourceLocation location;

    /// An error at the location of this value.
    Error error_here(std::string message) const { return bad_input(std::move(message), location); }
    /// The same result, but with its error, if it is one, at the location of this value. `context` begins the message.
    template <class T>
    Result<T> located(Result<T> result, const std::string& context = "") const {
        return result ? std::move(result) : Result<T>(error_here(context + result.error().message));
    }
};
using OptionalLocatedText = std::optional<LocatedText>;

/// A named value of a configuration file.
struct LocatedSetting {
    std::string name;  ///< "press.F_max"
    LocatedText value;
};

/// The override that one entry of a table means: "adc.bits" has a target of its own, "f_B" is for `default_target`.
inline ParameterOverride located_override(const LocatedSetting& entry, std::string_view default_target) {
    const auto dot = entry.name.rfind('.');
    const bool has_target = dot != std::string::npos;
    ParameterOverride out{has_target ? entry.name.substr(0, dot) : std::string(default_target),
                          has_target ? entry.name.substr(dot + 1) : entry.name, entry.value.text};
    out.typed = out.text(), out.location = entry.value.location;
    return out;
}

/// A value of a configuration file: a text or a number (both as text), a list, or a table. Its location is that of the value.
struct ConfigNode : LocatedText {
    enum class Kind { text, boolean, list, table, date };
    Kind kind = Kind::table;
    std::vector<ConfigNode> elements;                         ///< of a list
    std::vector<std::pair<LocatedText, ConfigNode>> entries;  ///< of a table, in the order of the keys; with the locations of the keys
    bool is_inline = false;                                   ///< a table in one line: {x = 1, y = 2}

    // Defined where the pair is complete; clang with libstdc++ 14 does not compile initializers of `entries` here.
    ConfigNode();
    ConfigNode(LocatedText, Kind);

    bool is_scalar() const { return kind == Kind::text; }  ///< true for a text or a number
    bool is_list() const { return kind == Kind::list; }
    bool is_table() const { return kind == Kind::table; }

    // The following are for tables. A missing key gives null or an empty result. The kinds of the values must have been checked, see
    // check_keys().
    const ConfigNode* get(std::string_view key) const;
    bool has(std::string_view key) const { return get(key) != nullptr; }
    std::span<const ConfigNode> elements_of(std::string_view key) const;  ///< of a list; those of [[key]] are its tables
    /// The settings of a table such as [set]. press.F_max = "2N" is a nested table in TOML; here it is a setting of the name "press.F_max".
    std::vector<LocatedSetting> settings(std::string_view key) const;
    /// Sets a text or a number, which gets no location.
    void set(std::string_view key, std::string text);
};

/// Parses the text of a file into its outermost table. `file` is its name for messages. Keys and values that are nested too deep are
/// errors.
Result<ConfigNode> parse_toml(std::string_view text, const std::string& file);

/// The text of a valid TOML file in a standard form without comments, equal for files with the same content.
std::string canonical_toml(std::string_view text);

/// A key that a table may have, and the kind of its value.
struct ConfigKey {
    /// settings: a table, perhaps nested, of texts and numbers; tables: [[name]]; any: the caller checks the value.
    enum class Kind { text, flag, flag_or_text, text_or_settings, list, settings, table, tables, any };
    std::string_view name;
    Kind kind = Kind::text;
    std::string_view one_for = {};  ///< of `tables`, for messages: what has one table each, "each region"

    constexpr ConfigKey(const char* name, Kind kind = Kind::text, std::string_view one_for = {})
        : name(name), kind(kind), one_for(one_for) {}
};

/// Returns an error if the table has a key that is not in `known`, or a value of another kind. `where` begins the message about an unknown
/// key: "[[region]]: ", or "".
Result<void> check_keys(const ConfigNode& table, std::span<const ConfigKey> known, std::string_view where);

/// Returns an error if a node is not of the kind of this key.
Result<void> check_kind(const ConfigNode&, const ConfigKey&);
/// Returns an error if a node is neither a text nor a number. `name` is that of the value, for the message.
Result<void> check_scalar(const ConfigNode&, std::string_view name);
/// Returns an error if a node is not a list of texts and numbers.
Result<void> check_list(const ConfigNode&, std::string_view name);

}  // namespace corpuscle
