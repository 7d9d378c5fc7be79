#pragma once
// Reads TOML tables. Values are returned as texts with their locations in the file. toml++ is slow to compile, so only one source file of
// each module includes this header.

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/parameter.hpp"
#include "core/text/located_text.hpp"

namespace corpuscle {

/// Returns an error if keys or values are nested so deep that toml++, which is recursive, would overflow the stack. Counts the dots of each
/// key and the open brackets and braces, outside comments and strings. `file` is the file's name for messages.
inline Result<void> check_nesting(std::string_view text, const std::string& file) {
    constexpr std::size_t max_dots = 32, max_open = 64;
    std::size_t dots = 0, open = 0, line = 1, line_start = 0;  // line_start: position in `text`
    const auto error_at = [&](std::size_t k, std::string_view items, std::size_t limit) {
        return bad_input(fmt::format("{} are nested more than {} deep", items, limit),
                         {file, static_cast<long>(line), static_cast<long>(k - line_start + 1)});
    };
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '#') {
            k = std::min(text.find('\n', k), text.size()) - 1;
        } else if (c == '"' || c == '\'') {
            // A string: skips to its closing quotes.
            const auto quotes = text.substr(k, 3) == std::string(3, c) ? 3U : 1U;
            for (k += quotes; k < text.size() && text.substr(k, quotes) != std::string(quotes, c); ++k) {
                if (c == '"' && text[k] == '\\') ++k;  // an escaped character
                if (k < text.size() && text[k] == '\n') {
                    if (quotes == 1) {  // the string is not closed; the parser reports it
                        --k;
                        break;
                    }
                    ++line, line_start = k + 1;
                }
            }
            k += quotes - 1;
        } else if (c == '\n') {
            ++line, line_start = k + 1, dots = 0;
        } else if (c == '.') {
            if (++dots > max_dots) return error_at(k, "keys", max_dots);
        } else if (c == '[' || c == '{') {
            dots = 0;
            if (++open > max_open) return error_at(k, "lists and tables", max_open);
        } else if (c == ']' || c == '}') {
            dots = 0, open -= open > 0;
        } else if (c == ',' || c == '=') {
            dots = 0;
        }
    }
    return {};
}

/// Parses the text of a TOML file, such as a sweep or a population. `file` is the file's name for messages.
inline Result<toml::table> parse_toml(std::string_view text, const std::string& file) {
    TRY(check_nesting(text, file));
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        const auto& at = error.source().begin;
        return bad_input(std::string(error.description()), {file, static_cast<long>(at.line), static_cast<long>(at.column)});
    }
}

/// Reads values from TOML tables. After an error, reading continues; the caller checks `first_error` at the end. In the functions, `name`
/// is the key of a value, and a missing value is not an error.
class TomlReader {
    const std::string& file_;

public:
    using Names = std::vector<std::string_view>;
    std::optional<Error> first_error;

    explicit TomlReader(const std::string& file) : file_(file) {}

    SourceLocation location_of(const toml::source_region& at) const {
        return {file_, static_cast<long>(at.begin.line), static_cast<long>(at.begin.column)};
    }
    void reject(const toml::source_region& at, std::string message) {
        if (!first_error) first_error = bad_input(std::move(message), location_of(at));
    }

    static bool is_one_of(const Names& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

    /// Stores an error if the table has a key that is not in `known`. `where` begins the message: "[[region]]: ", or "".
    void reject_unknown_keys(const toml::table& table, const Names& known, std::string_view where) {
        for (const auto& [key, value] : table)
            if (!is_one_of(known, key.str()))
                reject(key.source(), fmt::format("{}there is no '{}'{} (there are {})", where, key.str(), did_you_mean(key.str(), known),
                                                 fmt::join(known, ", ")));
    }

    /// The type of a node that is neither text nor number, for messages.
    static std::string_view type_name(const toml::node& node) {
        if (node.is_table()) return "a table";
        if (node.is_array() || node.is_array_of_tables()) return "a list";
        if (node.is_boolean()) return "true or false";
        return "a date";
    }

    /// The text of a node that is a text or a number, with `allow_boolean` also true or false. nullopt, with an error, for other nodes.
    OptionalLocatedText scalar(const toml::node& node, std::string_view name, bool allow_boolean = false) {
        LocatedText out{{}, location_of(node.source())};
        if (const auto* text = node.as_string())
            out.text = text->get();
        else if (const auto* integer = node.as_integer())
            out.text = fmt::format("{}", integer->get());
        else if (const auto* real = node.as_floating_point())
            out.text = fmt::format("{}", real->get());
        else if (const auto* boolean = node.as_boolean(); boolean && allow_boolean)
            out.text = boolean->get() ? "true" : "false";
        else
            return reject(node.source(), fmt::format("{} is {}; expected a text or a number", name, type_name(node))),
                   OptionalLocatedText{};
        return out;
    }
    /// The same for a value of a table. nullopt, without an error, if the key is missing.
    OptionalLocatedText scalar(const toml::table& table, std::string_view name, bool allow_boolean = false) {
        const auto* node = table.get(name);
        return node ? scalar(*node, name, allow_boolean) : std::nullopt;
    }

    /// The texts or numbers of an array; other elements are errors.
    std::vector<LocatedText> list(const toml::array& array, std::string_view name) {
        std::vector<LocatedText> out;
        for (const auto& item : array)
            if (auto element = scalar(item, fmt::format("an element of {}", name))) out.push_back(std::move(*element));
        return out;
    }
    /// The same for an array of a table; nullopt if the key is missing or its value is not an array.
    std::optional<std::vector<LocatedText>> list(const toml::table& table, std::string_view name) {
        const auto* node = table.get(name);
        if (!node) return {};
        const auto* array = node->as_array();
        if (!array) return reject(node->source(), fmt::format("{0} must be a list: {0} = [...]", name)), std::nullopt;
        return list(*array, name);
    }

    /// The table `name` inside the table `of`; null if the key is missing or its value is not a table.
    const toml::table* table(const toml::table& of, std::string_view name) {
        const auto* node = of.get(name);
        if (node && !node->is_table()) reject(node->source(), fmt::format("{0} must be a table: write [{0}] on a line of its own", name));
        return node ? node->as_table() : nullptr;
    }

    /// Calls `each` for every table [[name]] inside the table `of`. `one_for` states what has one table each, for messages: "each region".
    template <class F>
    void tables(const toml::table& of, std::string_view name, std::string_view one_for, F&& each) {
        const auto* node = of.get(name);
        if (!node) return;
        const auto message = [&] { return fmt::format("{0} must be tables: write [[{0}]] on a line of its own for {1}", name, one_for); };
        const auto* array = node->as_array();
        if (!array) return reject(node->source(), message());
        for (const auto& item : *array) {
            const auto* inner = item.as_table();
            if (!inner) return reject(item.source(), message());
            each(*inner);
        }
    }

    /// Appends the settings of a table such as [set] to `out`. press.F_max = "2N" is a nested table in TOML; here it is a setting of the
    /// name "press.F_max". Each name begins with `prefix`, which is "" for the outermost table.
    void settings(const toml::table& from, const std::string& prefix, std::vector<LocatedSetting>& out) {
        for (const auto& [key, value] : from) {
            const auto name = prefix + std::string(key.str());
            if (const auto* inner = value.as_table())
                settings(*inner, name + ".", out);
            else if (auto setting = scalar(value, name))
                out.push_back({name, std::move(*setting)});
        }
    }
};

}  // namespace corpuscle
