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
