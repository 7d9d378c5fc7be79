#include "sweep/store/results_layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_columns = 1900;  // SQLite's limit for a table is 2000
constexpr std::size_t max_label_bytes =
    std::size_t{4} << 20;  // bytes of the names, descriptions and labels of all columns of one kind; also of some entries of about
constexpr std::size_t max_time_bytes = std::size_t{32} << 20;   // bytes of the sample times of the probes
constexpr std::int64_t max_items = 1'000'000'000'000;           // equal to SweepPlan::max_items
constexpr std::size_t max_about_bytes = std::size_t{96} << 20;  // bytes of the table about

/// Names that differ between the formats of results files: tables and columns `items`, `item` and `description`, key `metadata` of the
/// table about.
struct FormatNames {
    const char *items, *item, *description, *metadata;
};
constexpr FormatNames first_format_names = {"units", "unit", "sentence", "facts"};
constexpr FormatNames current_names = {"items", "item", "description", "metadata"};

const FormatNames& names_of_format(std::int64_t format) { return format == 1 ? first_format_names : current_names; }

/// The statements that create the tables. The last one, for items, is continued by the columns of the sweep.
constexpr const char* tables = R"(
CREATE TABLE about(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE columns(position INTEGER PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, description TEXT NOT NULL,
                     words TEXT NOT NULL, at_least REAL, at_most REAL, stored TEXT NOT NULL);
CREATE TABLE spikes(item INTEGER NOT NULL, train INTEGER NOT NULL, times BLOB NOT NULL, PRIMARY KEY(item, train)) WITHOUT ROWID;
CREATE TABLE traces(item INTEGER NOT NULL, trace INTEGER NOT NULL, samples BLOB NOT NULL, PRIMARY KEY(item, trace)) WITHOUT ROWID;
CREATE TABLE items(item INTEGER PRIMARY KEY, ended TEXT NOT NULL, steps INTEGER NOT NULL, iterations INTEGER NOT NULL,
                   alone INTEGER NOT NULL, why TEXT NOT NULL)";

/// See ResultsLayout::stored_column_names.
std::vector<std::string> unique_names(const std::vector<SweepColumn>& axes, const std::vector<SweepColumn>& measures) {
    std::set<std::string> taken(ResultsLayout::item_columns.begin(), ResultsLayout::item_columns.end());
    std::vector<std::string> out;
    for (const auto* columns : {&axes, &measures})
        for (const auto& c : *columns) {
            auto name = c.name;
            for (int n = 2; !taken.insert(lower(name)).second; ++n) name = fmt::format("{}_{}", c.name, n);
            out.push_back(name);
        }
    return out;
}

/// The rest of a clause that begins with the name of a metadata entry: in which line its text differs from the earlier text.
std::string describe_difference(const std::string& now, const std::string& before) {
    std::size_t line = 1;
    const auto end = std::min(now.size(), before.size());
    for (std::size_t k = 0; k < end && now[k] == before[k]; ++k) line += now[k] == '\n';
    const bool are_multiline = now.find('\n') != now.npos && before.find('\n') != before.npos;
    return are_multiline ? fmt::format(" has changed since, in line {}", line) : fmt::format(" was '{}' and is '{}' now", before, now);
}

/// `how`: a clause, such as "its table 'spikes' has no column 'times'".
Error changed_by_other_program(const sql::Database& file, std::string_view how) {
    return bad_input(
        fmt::format("{}: it was changed by another program; use an earlier copy, or run the sweep into another file with --out", how),
        {file.path});
}

/// Returns an error if a table lacks one of the columns `wanted`, or if the table of items has another key than the item.
Result<void> check_table(const sql::Database& file, const std::string& table, const std::vector<std::string>& wanted,
                         const FormatNames& names = current_names) {
    auto rows = TRY(file.prepare("SELECT name, type, pk FROM pragma_table_info(?)"));
    rows.set(1, std::string_view(table));
    std::set<std::string> existing;
    bool has_integer_key = false;
    while (TRY(rows.step())) {
        existing.insert(lower(rows.text(0)));
        has_integer_key = has_integer_key || (rows.text(0) == names.item && lower(rows.text(1)) == "integer" && rows.integer(2) == 1);
    }
    if (existing.empty()) return changed_by_other_program(file, fmt::format("it has no table '{}'", table));
    for (const auto& name : wanted)
        if (!existing.contains(lower(name)))
            return changed_by_other_program(file, fmt::format("its table '{}' has no column '{}'", table, name));
    if (table == names.items && !has_integer_key)
        return changed_by_other_program(file,
                                        fmt::format("the column '{}' of its table '{}' is not an integer key", names.item, names.items));
    return {};
}

/// Checks the tables items, spikes and traces. `stored`: columns of axes and measures.
Result<void> check_tables(const sql::Database& file, const std::vector<std::string>& stored, const FormatNames& names) {
    std::vector<std::string> columns(ResultsLayout::item_columns.begin(), ResultsLayout::item_columns.end());
    columns[0] = names.item;
    columns.insert(columns.end(), stored.begin(), stored.end());
    TRY(check_table(file, names.items, columns, names));
    TRY(check_table(file, "spikes", {names.item, "train", "times"}));
    return check_table(file, "traces", {names.item, "trace", "samples"});
}

/// Shows the tables of a file of the first format under the names of the current one, by temporary views. A name in a query means the
/// temporary view rather than the file's own table, so all queries work unchanged. `stored`: names of the axes and measures in the file;
/// `shown`: in the views.
Result<void> show_first_format(const sql::Database& file, const std::vector<std::string>& stored, const std::vector<std::string>& shown) {
    std::string columns;
    for (std::size_t k = 0; k < stored.size(); ++k)
        columns += fmt::format(", {} AS {}", sql::quoted_name(stored[k]), sql::quoted_name(shown[k]));
    return file.run(
        fmt::format("PRAGMA temp_store = MEMORY;"
                    "CREATE TEMP VIEW items AS SELECT unit AS item, CASE ended WHEN 'capped' THEN 'truncated' WHEN 'lost' THEN "
                    "'diverged' ELSE ended END AS ended, steps, iterations, alone, why{} FROM main.units;"
                    "CREATE TEMP VIEW spikes AS SELECT unit AS item, train, times FROM main.spikes;"
                    "CREATE TEMP VIEW traces AS SELECT unit AS item, trace, samples FROM main.traces;",
                    columns));
}

/// Returns an error if the file has an item that is not one of the sweep's `items` items.
Result<void> check_items(const sql::Database& file, std::int64_t items) {
    auto rows = TRY(file.prepare("SELECT item FROM items WHERE item < 0 OR item >= ? LIMIT 1"));
    if (!TRY(rows.set(1, items).step())) return {};
    return changed_by_other_program(file,
                                    fmt::format("it holds item {}, of a sweep of {} items (0 to {})", rows.integer(0), items, items - 1));
}

/// Reads the axes or measures. `kind`: "axis" or "measure". Appends their names in the table items to `stored`.
Result<std::vector<SweepColumn>> read_columns(const sql::Database& file, const char* kind, const FormatNames& names,
                                              std::vector<std::string>& stored) {
    auto rows = TRY(file.prepare(fmt::format(
        "SELECT name, unit, {}, words, at_least, at_most, stored FROM columns WHERE kind = ? ORDER BY position", names.description)));
    rows.set(1, std::string_view(kind));
    std::vector<SweepColumn> out;
    std::size_t label_bytes = 0;
    while (TRY(rows.step())) {
        if (out.size() == max_columns) return changed_by_other_program(file, fmt::format("there are more than {} columns", max_columns));
        for (const int column : {0, 1, 2, 3, 6}) label_bytes += rows.bytes(column).size();
        if (label_bytes > max_label_bytes)
            return changed_by_other_program(file, fmt::format("its table columns holds more than {} MB of labels", max_label_bytes >> 20));
        SweepColumn c{rows.text(0), rows.text(1), rows.text(2)};
        c.labels = Json::parse(rows.text(3)).get<std::vector<std::string>>();
        if (!rows.is_null(4)) c.min = rows.number(4);
        if (!rows.is_null(5)) c.max = rows.number(5);
        out.push_back(std::move(c));
        stored.push_back(rows.text(6));
    }
    return out;
}

/// Writes the axes or measures. `stored`: names of all axes and measures in the table items; `first`: index of the first of these columns.
Result<void> write_columns(const sql::Database& file, const char* kind, const std::vector<SweepColumn>& columns,
                           const std::vector<std::string>& stored, std::size_t first) {
    auto row = TRY(file.prepare("INSERT INTO columns VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)"));
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto& c = columns[k];
        const auto labels = Json(c.labels).dump();
        row.set(1, static_cast<std::int64_t>(first + k)).set(2, std::string_view(kind)).set(3, std::string_view(c.name));
        row.set(4, std::string_view(c.unit)).set(5, std::string_view(c.description)).set(6, std::string_view(labels));
        c.min ? row.set(7, *c.min) : row.set_null(7);
        c.max ? row.set(8, *c.max) : row.set_null(8);
        row.set(9, std::string_view(stored[first + k]));
        TRY(row.finish());
    }
    return {};
}

Result<std::map<std::string, std::string>> read_about(const sql::Database& file) {
    auto rows = TRY(file.prepare("SELECT key, value FROM about"));
    std::map<std::string, std::string> out;
    std::size_t bytes = 0;
    while (TRY(rows.step())) {
        bytes += rows.bytes(0).size() + rows.bytes(1).size();
        if (bytes > max_about_bytes)
            return changed_by_other_program(file, fmt::format("its table about holds more than {} MB", max_about_bytes >> 20));
        out[rows.text(0)] = rows.text(1);
    }
    return out;
}

/// The format of a results file. Returns an error for any other SQLite file and for an unknown format.
Result<std::int64_t> format_of(const sql::Database& file) {
    const auto application = TRY(file.query_integer("PRAGMA application_id"));
    const auto file_version = TRY(file.query_integer("PRAGMA user_version"));
    if (application != ResultsLayout::application_id)
        return bad_input("is an SQLite file, but holds no results of a sweep; name another file", {file.path});
    if (file_version < 1) return changed_by_other_program(file, "its format version is missing");
    if (file_version > ResultsLayout::format)
        return bad_input(
            fmt::format("was written by a later corpuscle (its format is {}, this one reads up to {}): use the later version, or name "
                        "another file",
                        file_version, ResultsLayout::format),
            {file.path});
    return file_version;
}

/// Compares everything but the descriptions.
bool same_columns(const std::vector<SweepColumn>& a, const std::vector<SweepColumn>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SweepColumn& x, const SweepColumn& y) {
        return x.name == y.name && x.unit == y.unit && x.labels == y.labels && x.min == y.min && x.max == y.max;
    });
}

}  // namespace

ResultsLayout ResultsLayout::of(const SweepDescription& sweep) {
    ResultsLayout out{sweep, format, unique_names(sweep.axes, sweep.measures)};
    out.probe_units.resize(out.probe_names.size());
    return out;
}

Result<ResultsLayout> ResultsLayout::read(const sql::Database& file) {
    const auto stored_format = TRY(format_of(file));
    const auto& names = names_of_format(stored_format);
    ResultsLayout out;
    out.file_format = stored_format;
    TRY(check_table(file, "about", {"key", "value"}));
    TRY(check_table(file, "columns", {"position", "kind", "name", "unit", names.description, "words", "at_least", "at_most", "stored"}));
    try {
        auto about = TRY(read_about(file));
        about.try_emplace("trace_units", "[]");  // earlier versions did not write it
        for (const auto& [key, limit] : {std::pair{names.metadata, max_label_bytes},
                                         {"trains", max_label_bytes},
                                         {"traces", max_label_bytes},
                                         {"trace_units", max_label_bytes},
                                         {"trace_times", max_time_bytes}})
            if (about.at(key).size() > limit)
                return changed_by_other_program(file, fmt::format("'{}' of its table about is larger than {} MB", key, limit >> 20));
        out.item_count = std::stoll(about.at(names.items));
        for (const auto& name : Json::parse(about.at(names.metadata)).get<std::vector<std::string>>())
            if (const auto text = about.find(name); text != about.end()) out.metadata.push_back({name, text->second});
        out.train_names = Json::parse(about.at("trains")).get<std::vector<std::string>>();
        out.probe_names = Json::parse(about.at("traces")).get<std::vector<std::string>>();
        out.probe_units = Json::parse(about.at("trace_units")).get<std::vector<std::string>>();
        out.probe_units.resize(out.probe_names.size());
        out.probe_times = Json::parse(about.at("trace_times")).get<std::vector<double>>();
        for (auto [kind, into] : {std::pair{"axis", &out.axes}, std::pair{"measure", &out.measures}})
            *into = TRY(read_columns(file, kind, names, out.stored_column_names));
    } catch (const std::exception&) {  // of JSON, std::stoll or map::at, if a table was edited by hand
        return bad_input("is damaged: its tables about and columns cannot be read; name another file", {file.path});
    }
    if (out.item_count < 1 || out.item_count > max_items)
        return changed_by_other_program(file, fmt::format("its number of items is {}", out.item_count));
    TRY(check_tables(file, out.stored_column_names, names));
    if (stored_format == 1) {
        const auto shown = unique_names(out.axes, out.measures);
        TRY(show_first_format(file, out.stored_column_names, shown));
        out.stored_column_names = shown;
    }
    TRY(check_items(file, out.item_count));
    return out;
}

Result<void> ResultsLayout::write(const sql::Database& file) const {
    if (stored_column_names.size() > max_columns)
        return bad_input(fmt::format("{} axes and measures are more than a table can have ({}); vary or measure fewer",
                                     stored_column_names.size(), max_columns),
                         {file.path});
    std::string statements = fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; BEGIN;{}", application_id, format, tables);
    for (const auto& column : stored_column_names) statements += fmt::format(", {} REAL", sql::quoted_name(column));
    TRY(file.run(statements + ");"));
    auto row = TRY(file.prepare("INSERT INTO about VALUES(?, ?)"));
    std::map<std::string, std::string> all;
    std::vector<std::string> metadata_names;
    for (const auto& [name, text] : metadata) metadata_names.push_back(name), all[name] = text;
    all["items"] = fmt::format("{}", item_count);
    all["metadata"] = Json(metadata_names).dump();
    all["trains"] = Json(train_names).dump();
    all["traces"] = Json(probe_names).dump();
    all["trace_units"] = Json(probe_units).dump();
    all["trace_times"] = Json(probe_times).dump();
    for (const auto& [key, value] : all) TRY(row.set(1, std::string_view(key)).set(2, std::string_view(value)).finish());
    TRY(write_columns(file, "axis", axes, stored_column_names, 0));
    TRY(write_columns(file, "measure", measures, stored_column_names, axes.size()));
    return file.run("COMMIT");
}

std::string ResultsLayout::columns(std::string_view table) const {
    std::string out;
    for (const auto name : item_columns) out += fmt::format("{}{}{}", out.empty() ? "" : ", ", table, name);
    for (const auto& name : stored_column_names) out += fmt::format(", {}{}", table, sql::quoted_name(name));
    return out;
}

Result<void> ResultsLayout::check_current_format(const std::string& path) const {
    if (file_format == format) return {};
    return bad_input(
        fmt::format("has results of format {}, of an earlier corpuscle; this one writes format {} and only reads the earlier one "
                    "(sweep show, sweep dump). To compute or merge, run the sweep into another file: corpuscle sweep FILE --out NEW.sqlite",
                    file_format, format),
        {path});
}

std::string difference(const SweepDescription& now, const SweepDescription& earlier) {
    for (const auto& [name, text] : now.metadata) {
        const auto* before = earlier.find_metadata(name);
        if (!before) return fmt::format("it has no entry '{}'", name);
        if (*before != text) return name + describe_difference(text, *before);
    }
    for (const auto& entry : earlier.metadata)
        if (!now.find_metadata(entry.name)) return fmt::format("'{}' is not part of the sweep now", entry.name);
    if (now.item_count != earlier.item_count)
        return fmt::format("the number of items was {} and is {} now", earlier.item_count, now.item_count);
    if (!same_columns(now.axes, earlier.axes)) return "the axes have changed since";
    if (!same_columns(now.measures, earlier.measures)) return "the measures have changed since";
    if (now.train_names != earlier.train_names || now.probe_names != earlier.probe_names || now.probe_times != earlier.probe_times)
        return "the kept trains and traces have changed since";
    return "";
}

}  // namespace corpuscle
