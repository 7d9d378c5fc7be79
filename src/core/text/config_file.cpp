#include "core/text/config_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// Finds keys or values that are nested so deep that toml++, which is recursive, would overflow the stack. Counts the dots of each key and
/// the open brackets and braces, outside comments and strings.
class NestingCheck {
    static constexpr std::size_t max_dots = 32, max_open = 64;
    std::string_view text_;
    const std::string& file_;
    std::size_t dots_ = 0, open_ = 0, line_ = 1, line_start_ = 0;  // line_start_: position in text_

    Error error_at(std::size_t k, std::string_view items, std::size_t limit) const {
        return bad_input(fmt::format("{} are nested more than {} deep", items, limit),
                         {file_, static_cast<long>(line_), static_cast<long>(k - line_start_ + 1)});
    }
    /// The last character of the string that begins at k. If it is not closed, which the parser reports, the last one of the line.
    std::size_t skip_string(std::size_t k) {
        const char c = text_[k];
        const auto quotes = text_.substr(k, 3) == std::string(3, c) ? 3U : 1U;
        for (k += quotes; k < text_.size() && text_.substr(k, quotes) != std::string(quotes, c); ++k) {
            if (c == '"' && text_[k] == '\\') ++k;  // an escaped character
            if (k >= text_.size() || text_[k] != '\n') continue;
            if (quotes == 1) return k - 1;
            ++line_, line_start_ = k + 1;
        }
        return k + quotes - 1;
    }

public:
    NestingCheck(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    Result<void> run() {
        for (std::size_t k = 0; k < text_.size(); ++k) {
            const char c = text_[k];
            if (c == '#') k = std::min(text_.find('\n', k), text_.size()) - 1;
            if (c == '"' || c == '\'') k = skip_string(k);
            if (c == '\n') ++line_, line_start_ = k + 1;
            if (c == '.' && ++dots_ > max_dots) return error_at(k, "keys", max_dots);
            if (std::string_view("\n[{]},=").find(c) != std::string_view::npos) dots_ = 0;
            if ((c == '[' || c == '{') && ++open_ > max_open) return error_at(k, "lists and tables", max_open);
            if (c == ']' || c == '}') open_ -= open_ > 0;
        }
        return {};
    }
};

SourceLocation location_of(const toml::source_region& at, const std::string& file) {
    return {file, static_cast<long>(at.begin.line), static_cast<long>(at.begin.column)};
}

ConfigNode node_of(const toml::node& in, const std::string& file) {
    ConfigNode out{{{}, location_of(in.source(), file)}, ConfigNode::Kind::text};
    if (const auto* table = in.as_table()) {
        out.kind = ConfigNode::Kind::table, out.is_inline = table->is_inline();
        for (const auto& [key, value] : *table)
            out.entries.emplace_back(LocatedText{std::string(key.str()), location_of(key.source(), file)}, node_of(value, file));
    } else if (const auto* array = in.as_array()) {
        out.kind = ConfigNode::Kind::list;
        for (const auto& element : *array) out.elements.push_back(node_of(element, file));
    } else if (const auto* text = in.as_string()) {
        out.text = text->get();
    } else if (const auto* integer = in.as_integer()) {
        out.text = fmt::format("{}", integer->get());
    } else if (const auto* real = in.as_floating_point()) {
        out.text = fmt::format("{}", real->get());
    } else if (const auto* boolean = in.as_boolean()) {
        out.kind = ConfigNode::Kind::boolean, out.text = boolean->get() ? "true" : "false";
    } else {
        out.kind = ConfigNode::Kind::date;
    }
    return out;
}

/// Converts inline tables to regular ones.
void make_tables_regular(toml::node& node) {
    if (auto* table = node.as_table()) {
        table->is_inline(false);
        for (auto&& [key, value] : *table) make_tables_regular(value);
    }
    if (auto* array = node.as_array())
        for (auto& value : *array) make_tables_regular(value);
}

/// Appends the settings in a table. Each name begins with `prefix`, which is "" for the outermost table.
void append_settings(const ConfigNode& from, const std::string& prefix, std::vector<LocatedSetting>& out) {
    for (const auto& [key, value] : from.entries)
        value.is_table() ? append_settings(value, prefix + key.text + ".", out) : out.push_back({prefix + key.text, value});
}

Result<void> check_settings(const ConfigNode& table, const std::string& prefix) {
    for (const auto& [key, value] : table.entries)
        TRY(value.is_table() ? check_settings(value, prefix + key.text + ".") : check_scalar(value, prefix + key.text));
    return {};
}

Result<void> check_tables(const ConfigNode& node, const ConfigKey& key) {
    const auto error = [&](const ConfigNode& at) {
        return at.error_here(fmt::format("{0} must be tables: write [[{0}]] on a line of its own for {1}", key.name, key.one_for));
    };
    if (!node.is_list()) return error(node);
    for (const auto& element : node.elements)
        if (!element.is_table()) return error(element);
    return {};
}

}  // namespace

const ConfigNode* ConfigNode::get(std::string_view key) const {
    const auto at = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first.text == key; });
    return at == entries.end() ? nullptr : &at->second;
}

std::span<const ConfigNode> ConfigNode::elements_of(std::string_view key) const {
    const auto* node = get(key);
    return node ? std::span(node->elements) : std::span<const ConfigNode>();
}

std::vector<LocatedSetting> ConfigNode::settings(std::string_view key) const {
    std::vector<LocatedSetting> out;
    if (const auto* node = get(key)) append_settings(*node, "", out);
    return out;
}

void ConfigNode::set(std::string_view key, std::string text) {
    std::erase_if(entries, [&](const auto& entry) { return entry.first.text == key; });
    entries.emplace_back(LocatedText{std::string(key), {}}, ConfigNode{{std::move(text), {}}, Kind::text});
}

Result<ConfigNode> parse_toml(std::string_view text, const std::string& file) {
    TRY(NestingCheck(text, file).run());
    try {
        return node_of(toml::parse(text), file);
    } catch (const toml::parse_error& error) {
        return bad_input(std::string(error.description()), location_of(error.source(), file));
    }
}

std::string canonical_toml(std::string_view text) {
    auto top = toml::parse(text);
    make_tables_regular(top);
    std::ostringstream out;
    out << toml::toml_formatter{top} << '\n';
    return out.str();
}

Result<void> check_keys(const ConfigNode& table, std::span<const ConfigKey> known, std::string_view where) {
    const auto find = [&](std::string_view name) {
        return std::find_if(known.begin(), known.end(), [&](auto& k) { return k.name == name; });
    };
    for (const auto& [key, value] : table.entries) {
        if (find(key.text) != known.end()) continue;
        std::vector<std::string_view> names;
        for (const auto& k : known) names.push_back(k.name);
        return key.error_here(
            fmt::format("{}there is no '{}'{} (there are {})", where, key.text, did_you_mean(key.text, names), joined(names)));
    }
    for (const auto& [key, value] : table.entries) TRY(check_kind(value, *find(key.text)));
    return {};
}

Result<void> check_kind(const ConfigNode& node, const ConfigKey& key) {
    using Kind = ConfigKey::Kind;
    const bool is_flag = node.kind == ConfigNode::Kind::boolean;
    if (key.kind == Kind::any || (key.kind == Kind::flag_or_text && is_flag)) return {};
    if (key.kind == Kind::flag) return is_flag ? Result<void>() : node.error_here(fmt::format("{} must be true or false", key.name));
    if (key.kind == Kind::list) return check_list(node, key.name);
    if (key.kind == Kind::tables) return check_tables(node, key);
    const bool may_be_text = key.kind == Kind::text || key.kind == Kind::flag_or_text || key.kind == Kind::text_or_settings;
    const bool may_be_table = !may_be_text || key.kind == Kind::text_or_settings;
    if (may_be_text && !(may_be_table && node.is_table())) return check_scalar(node, key.name);
    if (!node.is_table()) return node.error_here(fmt::format("{0} must be a table: write [{0}] on a line of its own", key.name));
    return key.kind != Kind::table ? check_settings(node, "") : Result<void>();
}

Result<void> check_scalar(const ConfigNode& node, std::string_view name) {
    using Kind = ConfigNode::Kind;
    if (node.is_scalar()) return {};
    return node.error_here(fmt::format("{} is {}; expected a text or a number", name,
                                       node.kind == Kind::table     ? "a table"
                                       : node.kind == Kind::list    ? "a list"
                                       : node.kind == Kind::boolean ? "true or false"
                                                                    : "a date"));
}

Result<void> check_list(const ConfigNode& node, std::string_view name) {
    if (!node.is_list()) return node.error_here(fmt::format("{0} must be a list: {0} = [...]", name));
    for (const auto& element : node.elements) TRY(check_scalar(element, fmt::format("an element of {}", name)));
    return {};
}

}  // namespace corpuscle
