#include "reproduction/data/study_file.hpp"

#include <fmt/format.h>

#include <array>
#include "core/parameter.hpp"
#include "core/text/config_file.hpp"

namespace corpuscle {

std::vector<std::string> StudyItem::list(const std::string& key) const {
    std::vector<std::string> out;
    if (const auto found = lists.find(key); found != lists.end())
        for (const auto& element : found->second) out.push_back(element.text);
    return out;
}

namespace {

using KeyKind = ConfigKey::Kind;

struct ItemKind {
    std::string_view name;
    std::vector<ConfigKey> keys;
    std::vector<std::string_view> required = {};
};

constexpr ConfigKey each_key("each", KeyKind::any), run_key("run", KeyKind::tables, "each run"),
    trial_key("trial", KeyKind::tables, "each trial"), claim_key("claim", KeyKind::tables, "each claim"),
    plot_key("plot", KeyKind::tables, "each plot"), note_key("note", KeyKind::tables, "each note"),
    group_key("group", KeyKind::tables, "each group"), values_key("values", KeyKind::any), texts_key("texts", KeyKind::settings);

/// The kinds of tables in a study file, with their keys.
const std::vector<ItemKind>& item_kinds() {
    static const std::vector<ItemKind> kinds = {
        {"run",
         {each_key, "name", "circuit", "netlist", ConfigKey("replace", KeyKind::list), "replace_in", ConfigKey("settings", KeyKind::list),
          "directives", ConfigKey("ideal_mirrors", KeyKind::flag)}},
        {"trial",
         {each_key, "name", "afferent", "stimulus", ConfigKey("settings", KeyKind::list), "rate", "seed",
          ConfigKey("probes", KeyKind::list), ConfigKey("thesis_algorithm", KeyKind::flag)},
         {"name"}},
        {"claim",
         {each_key, "label", "value", ConfigKey("true", KeyKind::flag_or_text), "unit", "published", "derived", "tolerance", "min", "max",
          "kind", "source", "explain", "explain_if_needed", "explain_if_undefined"},
         {"label"}},
        {"plot",
         {each_key, "title", "x", "y", ConfigKey("log_x", KeyKind::flag), ConfigKey("log_y", KeyKind::flag), "published",
          ConfigKey("series", KeyKind::tables, "each series")},
         {"title", "series"}},
        {"series", {each_key, "name", "line", "points", "path", "raster"}, {"name"}},
        {"note", {each_key, "text"}, {"text"}},
        {"group", {each_key, values_key, texts_key, run_key, trial_key, claim_key, plot_key, note_key, group_key}},
        {"file",
         {"title", "question", "kind", values_key, texts_key, run_key, trial_key, claim_key, plot_key, note_key, group_key},
         {"title", "question", "kind"}},
    };
    return kinds;
}
constexpr std::string_view kinds_in_a_block[] = {"run", "trial", "claim", "plot", "note", "group"};

/// Names with braces, "{corner}", and values.
using Variables = std::vector<std::pair<std::string, std::string>>;

LocatedText substitute(LocatedText in, const Variables& variables) {
    for (const auto& [name, value] : variables)
        for (auto at = in.text.find(name); at != std::string::npos; at = in.text.find(name, at + value.size()))
            in.text.replace(at, name.size(), value);
    return in;
}

void add_variable(Variables& variables, std::string_view key, const LocatedText& value, const Variables& outer) {
    variables.emplace_back(fmt::format("{{{}}}", key), substitute(value, outer).text);
}

Result<void> check_item(const ConfigNode& table, std::string_view kind_name) {
    const auto& kind = *std::find_if(item_kinds().begin(), item_kinds().end(), [&](const auto& k) { return k.name == kind_name; });
    const auto where = kind_name == "file" ? std::string() : fmt::format("{}: ", kind_name);
    TRY(check_keys(table, kind.keys, where));
    for (const auto key : kind.required)
        if (!table.has(key)) return table.error_here(fmt::format("{}'{}' is missing", where, key));
    return {};
}

/// The variables of each repetition of a table, added to those around it. A repetition is a row of each = [{ corner = "ss", limit = 1
/// }, { corner = "ff", limit = 2 }] or, written by columns, of each = { corner = ["ss", "ff"], limit = [1, 2] }.
Result<std::vector<Variables>> repetitions(const ConfigNode& table, const Variables& outer) {
    const auto* each = table.get("each");
    std::vector<Variables> out;
    if (!each) {
        out.push_back(outer);
        return out;
    }
    for (const auto& [key, node] : each->entries) {
        TRY(check_list(node, key.text));
        if (out.empty()) out.assign(node.elements.size(), outer);
        if (out.size() != node.elements.size())
            return node.error_here(fmt::format("each: {} has {} elements, another list {}", key.text, node.elements.size(), out.size()));
        for (std::size_t k = 0; k < out.size(); ++k) add_variable(out[k], key.text, node.elements[k], outer);
    }
    if (each->is_table()) return out;
    constexpr auto rows = std::to_array<ConfigKey>({ConfigKey("each", KeyKind::tables, "each repetition")});
    TRY(check_kind(*each, rows[0]));
    for (const auto& row : each->elements) {
        auto& variables = out.emplace_back(outer);
        for (const auto& [key, node] : row.entries) {
            TRY(check_scalar(node, key.text));
            add_variable(variables, key.text, node, outer);
        }
    }
    return out;
}

Result<void> define(const LocatedText& name, StudyDefinition definition, StudyScope& scope) {
    if (scope.definitions.emplace(name.text, std::move(definition)).second) return {};
    return name.error_here(fmt::format("there are two values '{}'", name.text));
}

/// Reads the definitions of a table `values`: expressions, or curves as pairs of expressions.
Result<void> read_definitions(const ConfigNode& values, const Variables& variables, StudyScope& scope) {
    for (const auto& [key, node] : values.entries) {
        if (key.text == "each") continue;
        StudyDefinition definition;
        if (node.is_table()) {
            for (const auto& repetition : TRY(repetitions(node, variables))) {
                const auto *x = node.get("x"), *y = node.get("y");
                if (!x || !y || !x->is_scalar() || !y->is_scalar())
                    return node.error_here(fmt::format("{} must be a text, or a table with each, x and y", key.text));
                definition.pairs.emplace_back(substitute(*x, repetition), substitute(*y, repetition));
            }
        } else {
            TRY(check_scalar(node, key.text));
            definition.expression = substitute(node, variables);
        }
        TRY(define({substitute(key, variables).text, node.location}, std::move(definition), scope));
    }
    return {};
}

Result<StudyItem> read_item(std::string_view kind, const ConfigNode& table, const Variables& variables, std::size_t scope) {
    StudyItem out{std::string(kind), table.location, scope, {}, {}};
    for (const auto& [key, node] : table.entries) {
        if (key.text == "each" || key.text == "series") continue;
        if (node.is_list())
            for (const auto& element : node.elements) out.lists[key.text].push_back(substitute(element, variables));
        else
            out.texts.emplace(key.text, substitute(node, variables));
    }
    for (const auto& series : table.elements_of("series")) {
        TRY(check_item(series, "series"));
        for (const auto& repetition : TRY(repetitions(series, variables)))
            out.series.push_back(TRY(read_item("series", series, repetition, scope)));
    }
    return out;
}

/// Reads the items of the file or of a group in the order of their lines.
Result<void> read_block(const ConfigNode& block, const Variables& variables, std::size_t outer, StudyFile& out) {
    const auto scope = out.scopes.size();
    out.scopes.push_back({outer, {}});
    if (const auto* values = block.get("values")) {
        constexpr ConfigKey key = {"values", KeyKind::tables, "each list of variables"};
        if (!values->is_table()) TRY(check_kind(*values, key));
        for (const auto& table : values->is_table() ? std::span(values, 1) : std::span(values->elements))
            for (const auto& repetition : TRY(repetitions(table, variables))) TRY(read_definitions(table, repetition, out.scopes[scope]));
    }
    for (const auto& s : block.settings("texts"))
        TRY(define({s.name, s.value.location}, {substitute(s.value, variables), true, {}}, out.scopes[scope]));
    std::vector<std::pair<std::string_view, const ConfigNode*>> tables;
    for (const auto kind : kinds_in_a_block)
        for (const auto& table : block.elements_of(kind)) tables.emplace_back(kind, &table);
    std::sort(tables.begin(), tables.end(), [](const auto& a, const auto& b) { return a.second->location.line < b.second->location.line; });
    for (const auto& [kind, table] : tables) {
        TRY(check_item(*table, kind));
        for (const auto& repetition : TRY(repetitions(*table, variables)))
            if (kind == "group")
                TRY(read_block(*table, repetition, scope, out));
            else
                out.items.push_back(TRY(read_item(kind, *table, repetition, scope)));
    }
    return {};
}

}  // namespace

Result<ClaimKind> read_claim_kind(const LocatedText& name) {
    const auto kind = find_claim_kind(name.text);
    if (!kind) return name.error_here(kind.error().message);
    return kind;
}

Result<StudyFile> read_study_file(std::string_view text, const std::string& file) {
    const auto top = TRY(parse_toml(text, file));
    TRY(check_item(top, "file"));
    StudyFile out;
    out.title = *top.get("title"), out.question = *top.get("question");
    out.kind = TRY(read_claim_kind(*top.get("kind")));
    TRY(read_block(top, {}, StudyScope::no_scope, out));
    return out;
}

}  // namespace corpuscle
