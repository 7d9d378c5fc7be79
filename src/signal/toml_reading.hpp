#pragma once
// TOML to what was said in it. toml++ is a heavy header: one file a room includes this one.

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "signal/field.hpp"
#include "signal/said.hpp"

namespace corpuscle {

/// Where keys or values are nested so deep that toml++, which goes down by recursion, would run out of stack; nothing: nowhere.
/// Counted are the dots of a key and the brackets that are open.
inline std::optional<Error> too_deep(std::string_view text, const std::string& file) {
    constexpr std::size_t most_dots = 32, most_open = 64;
    std::size_t dots = 0, open = 0, line = 1, line_at = 0;
    const auto wrong = [&](std::size_t k, std::string_view what, std::size_t most) {
        return bad_input(fmt::format("{} nested more than {} deep", what, most),
                         {file, static_cast<long>(line), static_cast<long>(k - line_at + 1)});
    };
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '#') {
            k = std::min(text.find('\n', k), text.size()) - 1;
        } else if (c == '"' || c == '\'') {
            const auto quotes = text.substr(k, 3) == std::string(3, c) ? 3U : 1U;
            for (k += quotes; k < text.size() && text.substr(k, quotes) != std::string(quotes, c); ++k) {
                if (c == '"' && text[k] == '\\') ++k;
                if (k < text.size() && text[k] == '\n') {
                    if (quotes == 1) {  // it is not closed; the parser says so
                        --k;
                        break;
                    }
                    ++line, line_at = k + 1;
                }
            }
            k += quotes - 1;
        } else if (c == '\n') {
            ++line, line_at = k + 1, dots = 0;
        } else if (c == '.') {
            if (++dots > most_dots) return wrong(k, "keys", most_dots);
        } else if (c == '[' || c == '{') {
            dots = 0;
            if (++open > most_open) return wrong(k, "lists and tables", most_open);
        } else if (c == ']' || c == '}') {
            dots = 0, open -= open > 0;
        } else if (c == ',' || c == '=') {
            dots = 0;
        }
    }
    return {};
}

/// The one way in which TOML is read: for sweeps and populations.
inline Result<toml::table> parse_toml(std::string_view text, const std::string& file) {
    if (auto wrong = too_deep(text, file)) return *wrong;
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        const auto& at = error.source().begin;
        return bad_input(std::string(error.description()), {file, static_cast<long>(at.line), static_cast<long>(at.column)});
    }
}

/// Reads tables; the first thing that is wrong is kept, and what comes after it does not matter.
class TomlReading {
    const std::string& file_;

public:
    using Names = std::vector<std::string_view>;
    std::optional<Error> wrong;

    explicit TomlReading(const std::string& file) : file_(file) {}

    Place place(const toml::source_region& at) const {
        return {file_, static_cast<long>(at.begin.line), static_cast<long>(at.begin.column)};
    }
    void refuse(const toml::source_region& at, std::string sentence) {
        if (!wrong) wrong = bad_input(std::move(sentence), place(at));
    }

    static bool is_one_of(const Names& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

    void only(const toml::table& table, const Names& known, std::string_view where) {
        for (const auto& [key, value] : table)
            if (!is_one_of(known, key.str()))
                refuse(key.source(), fmt::format("{}there is no '{}'{} (there are {})", where, key.str(), did_you_mean(key.str(), known),
                                                 fmt::join(known, ", ")));
    }

    static std::string_view kind(const toml::node& node) {
        if (node.is_table()) return "a table";
        if (node.is_array() || node.is_array_of_tables()) return "a list";
        if (node.is_boolean()) return "true or false";
        return "a date";
    }

    /// A text or a number; `truth`: or true, false.
    MaybeSaid scalar(const toml::node& node, std::string_view name, bool truth = false) {
        Said out{{}, place(node.source())};
        if (const auto* text = node.as_string())
            out.text = text->get();
        else if (const auto* whole = node.as_integer())
            out.text = fmt::format("{}", whole->get());
        else if (const auto* real = node.as_floating_point())
            out.text = fmt::format("{}", real->get());
        else if (const auto* boolean = node.as_boolean(); boolean && truth)
            out.text = boolean->get() ? "true" : "false";
        else
            return refuse(node.source(), fmt::format("{} is {}; a text or a number is wanted", name, kind(node))), MaybeSaid{};
        return out;
    }
    MaybeSaid scalar(const toml::table& table, std::string_view name, bool truth = false) {
        const auto* node = table.get(name);
        return node ? scalar(*node, name, truth) : std::nullopt;
    }

    std::vector<Said> list(const toml::array& array, std::string_view name) {
        std::vector<Said> out;
        for (const auto& one : array)
            if (auto said = scalar(one, fmt::format("an element of {}", name))) out.push_back(std::move(*said));
        return out;
    }
    std::optional<std::vector<Said>> list(const toml::table& table, std::string_view name) {
        const auto* node = table.get(name);
        if (!node) return {};
        const auto* array = node->as_array();
        if (!array) return refuse(node->source(), fmt::format("{} wants a list: {} = [...]", name, name)), std::nullopt;
        return list(*array, name);
    }

    const toml::table* table(const toml::table& of, std::string_view name) {
        const auto* node = of.get(name);
        if (node && !node->is_table()) refuse(node->source(), fmt::format("{} wants a table: [{}] on a line of its own", name, name));
        return node ? node->as_table() : nullptr;
    }

    /// The tables of [[name]].
    template <class F>
    void tables(const toml::table& of, std::string_view name, std::string_view one_for, F&& each) {
        const auto* node = of.get(name);
        if (!node) return;
        const auto sentence = [&] { return fmt::format("{0} wants tables: [[{0}]] on a line of its own, one for {1}", name, one_for); };
        const auto* array = node->as_array();
        if (!array) return refuse(node->source(), sentence());
        for (const auto& one : *array) {
            const auto* inner = one.as_table();
            if (!inner) return refuse(one.source(), sentence());
            each(*inner);
        }
    }

    /// [set]: press.F_max = "2N" is a table in a table, and means what "press.F_max" does.
    void settings(const toml::table& from, const std::string& before, std::vector<SaidSetting>& out) {
        for (const auto& [key, value] : from) {
            const auto name = before + std::string(key.str());
            if (const auto* inner = value.as_table())
                settings(*inner, name + ".", out);
            else if (auto said = scalar(value, name))
                out.push_back({name, std::move(*said)});
        }
    }
};

}  // namespace corpuscle
