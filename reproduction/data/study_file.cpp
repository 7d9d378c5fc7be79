#include "reproduction/data/study_file.hpp"

#include "core/text/toml_reader.hpp"

namespace corpuscle {

std::vector<std::string> StudyItem::list(const std::string& key) const {
    std::vector<std::string> out;
    if (const auto found = lists.find(key); found != lists.end())
        for (const auto& element : found->second) out.push_back(element.text);
    return out;
}

namespace {

struct ItemKind {
    std::string_view name;
    std::vector<std::string_view> keys, required;
};
const std::vector<ItemKind>& item_kinds() {
    static const std::vector<ItemKind> kinds = {
        {"run", {"each", "name", "circuit", "netlist", "replace", "replace_in", "settings", "directives", "ideal_mirrors"}, {}},
        {"trial", {"each", "name", "afferent", "stimulus", "settings", "rate", "seed", "probes", "thesis_algorithm"}, {"name"}},
        {"claim",
         {"each", "label", "value", "true", "unit", "published", "derived", "min", "max", "source", "explain", "explain_if_needed",
          "explain_if_undefined"},
         {"label"}},
        {"plot", {"each", "title", "x", "y", "log_x", "log_y", "published", "series"}, {"title", "series"}},
        {"series", {"each", "name", "line", "points", "path", "raster"}, {"name"}},
        {"note", {"each", "text"}, {"text"}},
        {"group", {"each", "values", "texts", "run", "trial", "claim", "plot", "note", "group"}, {}},
        {"file", {"title", "question", "values", "texts", "run", "trial", "claim", "plot", "note", "group"}, {"title", "question"}},
    };
    return kinds;
}
const ItemKind& item_kind(std::string_view name) {
    return *std::find_if(item_kinds().begin(), item_kinds().end(), [&](const auto& kind) { return kind.name == name; });
}
const std::vector<std::string_view> list_keys = {"settings", "replace", "probes"};
const std::vector<std::string_view> flag_keys = {"ideal_mirrors", "thesis_algorithm", "log_x", "log_y"};
constexpr std::string_view kinds_in_a_block[] = {"run", "trial", "claim", "plot", "note", "group"};

class StudyFileReader {
    using Variables = std::vector<std::pair<std::string, std::string>>;  // names with braces, "{corner}", and values
    TomlReader reader_;
    StudyFile out_;

public:
    explicit StudyFileReader(const std::string& file) : reader_(file) {}

    Result<StudyFile> read(const toml::table& all) {
        check_keys(all, "file");
        if (auto title = reader_.scalar(all, "title")) out_.title = *title;
        if (auto question = reader_.scalar(all, "question")) out_.question = *question;
        read_block(all, {}, StudyScope::no_scope);
        if (reader_.first_error) return *reader_.first_error;
        return std::move(out_);
    }

private:
    void check_keys(const toml::table& table, std::string_view kind_name) {
        const auto& kind = item_kind(kind_name);
        const auto where = kind_name == "file" ? std::string() : fmt::format("{}: ", kind_name);
        reader_.reject_unknown_keys(table, kind.keys, where);
        for (const auto key : kind.required)
            if (!table.contains(key)) reader_.reject(table.source(), fmt::format("{}'{}' is missing", where, key));
    }

    static LocatedText substitute(LocatedText in, const Variables& variables) {
        for (const auto& [name, value] : variables)
            for (auto at = in.text.find(name); at != std::string::npos; at = in.text.find(name, at + value.size()))
                in.text.replace(at, name.size(), value);
        return in;
    }

    /// The variables of each repetition of a table, added to those around it. A repetition is a row of each = [{ corner = "ss", limit = 1
    /// }, { corner = "ff", limit = 2 }] or, written by columns, of each = { corner = ["ss", "ff"], limit = [1, 2] }.
    std::vector<Variables> repetitions(const toml::table& table, const Variables& outer) {
        const auto* each = table.get("each");
        if (!each) return {outer};
        std::vector<Variables> out;
        if (const auto* columns = each->as_table()) {
            for (const auto& [key, node] : *columns) add_column(*columns, key.str(), node, outer, out);
        } else {
            reader_.tables(table, "each", "each repetition", [&](const toml::table& row) {
                auto& variables = out.emplace_back(outer);
                for (const auto& [key, node] : row) add_variable(variables, key.str(), reader_.scalar(node, key.str()), outer);
            });
        }
        return out;
    }

    void add_column(const toml::table& columns, std::string_view key, const toml::node& node, const Variables& outer,
                    std::vector<Variables>& out) {
        const auto values = reader_.list(columns, key);
        if (!values) return;
        if (out.empty()) out.assign(values->size(), outer);
        if (out.size() != values->size())
            reader_.reject(node.source(), fmt::format("each: {} has {} elements, another list {}", key, values->size(), out.size()));
        for (std::size_t k = 0; k < std::min(out.size(), values->size()); ++k) add_variable(out[k], key, (*values)[k], outer);
    }

    static void add_variable(Variables& variables, std::string_view key, const OptionalLocatedText& value, const Variables& outer) {
        if (value) variables.emplace_back(fmt::format("{{{}}}", key), substitute(*value, outer).text);
    }

    /// Reads the items of the file or of a group in the order of their lines.
    void read_block(const toml::table& block, const Variables& variables, std::size_t outer) {
        const auto scope = out_.scopes.size();
        out_.scopes.push_back({outer, {}});
        const auto read_values = [&](const toml::table& values) {
            for (const auto& repetition : repetitions(values, variables)) read_definitions(values, repetition, out_.scopes[scope]);
        };
        if (const auto* values = block.get_as<toml::table>("values"))
            read_values(*values);
        else
            reader_.tables(block, "values", "each list of variables", read_values);
        if (const auto* texts = reader_.table(block, "texts"))
            for (const auto& [key, node] : *texts)
                if (auto text = reader_.scalar(node, key.str()))
                    define(std::string(key.str()), {substitute(std::move(*text), variables), true, {}}, node, out_.scopes[scope]);
        std::vector<std::pair<std::string_view, const toml::table*>> tables;
        for (const auto kind : kinds_in_a_block)
            reader_.tables(block, kind, fmt::format("each {}", kind), [&](const toml::table& t) { tables.emplace_back(kind, &t); });
        std::sort(tables.begin(), tables.end(),
                  [](const auto& a, const auto& b) { return a.second->source().begin.line < b.second->source().begin.line; });
        for (const auto& [kind, table] : tables) {
            check_keys(*table, kind);
            for (const auto& repetition : repetitions(*table, variables))
                kind == "group" ? read_block(*table, repetition, scope) : out_.items.push_back(item(kind, *table, repetition, scope));
        }
    }

    void read_definitions(const toml::table& values, const Variables& variables, StudyScope& scope) {
        for (const auto& [key, node] : values) {
            if (key.str() == "each") continue;
            StudyDefinition definition;
            if (const auto* curve = node.as_table()) {
                for (const auto& repetition : repetitions(*curve, variables)) {
                    const auto x = reader_.scalar(*curve, "x"), y = reader_.scalar(*curve, "y");
                    if (!x || !y) reader_.reject(node.source(), fmt::format("{} must be a text, or a table with each, x and y", key.str()));
                    if (x && y) definition.pairs.emplace_back(substitute(*x, repetition), substitute(*y, repetition));
                }
            } else if (const auto text = reader_.scalar(node, key.str())) {
                definition.expression = substitute(*text, variables);
            }
            define(substitute({std::string(key.str()), {}}, variables).text, std::move(definition), node, scope);
        }
    }

    void define(const std::string& name, StudyDefinition definition, const toml::node& node, StudyScope& scope) {
        if (!scope.definitions.emplace(name, std::move(definition)).second)
            reader_.reject(node.source(), fmt::format("there are two values '{}'", name));
    }

    StudyItem item(std::string_view kind, const toml::table& table, const Variables& variables, std::size_t scope) {
        StudyItem out{std::string(kind), reader_.location_of(table.source()), scope, {}, {}};
        for (const auto& [key, node] : table) {
            if (key.str() == "series")
                read_series(table, variables, scope, out);
            else if (key.str() != "each")
                read_value(std::string(key.str()), node, variables, out);
        }
        return out;
    }

    void read_value(const std::string& key, const toml::node& node, const Variables& variables, StudyItem& out) {
        const auto* array = node.as_array();
        if (TomlReader::is_one_of(list_keys, key) && !array)
            return reader_.reject(node.source(), fmt::format("{0} must be a list: {0} = [...]", key));
        if (TomlReader::is_one_of(flag_keys, key) && !node.is_boolean())
            return reader_.reject(node.source(), fmt::format("{} must be true or false", key));
        if (TomlReader::is_one_of(list_keys, key)) {
            for (auto& element : reader_.list(*array, key)) out.lists[key].push_back(substitute(std::move(element), variables));
        } else if (auto text = reader_.scalar(node, key, true)) {
            out.texts.emplace(key, substitute(std::move(*text), variables));
        }
    }

    void read_series(const toml::table& plot, const Variables& variables, std::size_t scope, StudyItem& out) {
        reader_.tables(plot, "series", "each series", [&](const toml::table& series) {
            check_keys(series, "series");
            for (const auto& repetition : repetitions(series, variables)) out.series.push_back(item("series", series, repetition, scope));
        });
    }
};

}  // namespace

Result<StudyFile> read_study_file(std::string_view text, const std::string& file) {
    const auto table = TRY(parse_toml(text, file));
    return StudyFileReader(file).read(table);
}

}  // namespace corpuscle
