#include "io/text/json_records.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text/ascii_text.hpp"
#include "io/recording/samples.hpp"

namespace corpuscle {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t max_document = std::size_t{64} << 20;  // bytes
constexpr int max_depth = 16;                                // nested brackets

/// The text with null instead of NaN and Infinity, which Python writes but JSON does not have. nullopt if brackets are nested too deep.
/// Stops after `max_bytes` bytes of the result; stores in `read` how many bytes of `text` these are.
std::optional<std::string> strict_json(std::string_view text, std::size_t max_bytes = std::string_view::npos, std::size_t* read = nullptr) {
    std::string out;
    out.reserve(std::min(text.size(), max_bytes));
    bool quoted = false;
    int depth = 0;
    std::size_t k = 0;
    for (; k < text.size() && out.size() < max_bytes; ++k) {
        const char c = text[k];
        if (quoted) {
            out += c;
            if (c == '\\' && k + 1 < text.size()) out += text[++k];
            quoted = c != '"';
            continue;
        }
        quoted = c == '"';
        if ((c == '{' || c == '[') && ++depth > max_depth) return {};
        if (c == '}' || c == ']') --depth;
        std::size_t literal_size = 0;
        for (const std::string_view w : {"-Infinity", "Infinity", "NaN"})
            if (text.substr(k).starts_with(w)) literal_size = std::max(literal_size, w.size());
        if (literal_size > 0)
            out += "null", k += literal_size - 1;
        else
            out += c;
    }
    if (read) *read = k;
    return out;
}

/// Receives the events of nlohmann's SAX parser and builds the document. Unlike nlohmann's own builder, it appends members to an object
/// without a search for duplicate names, which would take quadratic time for an object with many members.
class DocumentBuilder {
    using Members = std::vector<std::pair<const std::string, OrderedJson>>;
    static constexpr std::size_t values_between_checks = 4096;
    const std::function<bool()>& should_continue_;
    std::vector<OrderedJson*> open_;  // the objects and arrays around the next value, outermost first
    std::string key_;                 // name of the next member of an object
    std::size_t values_ = 0;          // number of values so far

    /// Adds the next value. Returns false to stop the parser.
    bool add(OrderedJson value) {
        if (++values_ % values_between_checks == 0 && !should_continue_()) return interrupted = true, false;
        const bool is_container = value.is_structured();
        OrderedJson* at = &document;
        if (open_.empty()) {
            document = std::move(value);
        } else if (open_.back()->is_array()) {
            auto& list = open_.back()->get_ref<OrderedJson::array_t&>();
            list.push_back(std::move(value));
            at = &list.back();
        } else {
            auto& members = static_cast<Members&>(open_.back()->get_ref<OrderedJson::object_t&>());
            members.emplace_back(std::move(key_), std::move(value));
            at = &members.back().second;
        }
        if (is_container) open_.push_back(at);
        return true;
    }

public:
    explicit DocumentBuilder(const std::function<bool()>& should_continue) : should_continue_(should_continue) {}
    OrderedJson document;
    std::optional<std::size_t> syntax_error_at;  ///< number of bytes read when the parser met a syntax error; nullopt: no syntax error
    bool interrupted = false;                    ///< true if should_continue returned false

    bool null() { return add(nullptr); }
    bool boolean(bool x) { return add(x); }
    bool number_integer(OrderedJson::number_integer_t x) { return add(x); }
    bool number_unsigned(OrderedJson::number_unsigned_t x) { return add(x); }
    bool number_float(OrderedJson::number_float_t x, const std::string&) { return add(x); }
    bool string(std::string& x) { return add(std::move(x)); }
    bool binary(OrderedJson::binary_t&) { return false; }
    bool start_object(std::size_t) { return add(OrderedJson::object()); }
    bool start_array(std::size_t) { return add(OrderedJson::array()); }
    bool key(std::string& x) { return key_ = std::move(x), true; }
    bool end_object() { return open_.pop_back(), true; }
    bool end_array() { return open_.pop_back(), true; }
    bool parse_error(std::size_t byte, const std::string&, const nlohmann::json::exception& e) {
        constexpr int first_syntax_error = 100, end_of_syntax_errors = 200;  // range of nlohmann's ids of syntax errors
        if (e.id >= first_syntax_error && e.id < end_of_syntax_errors) syntax_error_at = byte;
        return false;
    }
};

/// Implements read_json_records().
class JsonReader {
    using RecordHandler = std::function<Result<void>(std::span<const JsonField>, long)>;
    LineReader& lines_;
    const RecordHandler& on_record_;
    const std::function<bool()>& should_continue_;
    JsonMetadata* metadata_;         // may be null
    std::vector<JsonField> fields_;  // of the current record

    /// An error at a line; 0 for an error of the entire document.
    Error error_at(std::string message, long line = 0) const { return bad_input(std::move(message), {lines_.path(), line}); }

    /// Parses a text that begins in line `line`.
    Result<OrderedJson> parse(std::string_view text, long line) const {
        const auto strict = strict_json(text);
        if (!strict) return error_at(fmt::format("this JSON is nested more than {} deep, so it is not a table", max_depth), line);
        DocumentBuilder builder(should_continue_);
        if (OrderedJson::sax_parse(*strict, &builder)) return std::move(builder.document);
        if (builder.interrupted) return interrupted_error();
        if (!builder.syntax_error_at) return error_at("this JSON contains a number that is too large", line);
        std::size_t at = 0;  // position of the syntax error in `text`; the parser's position is in `strict`
        static_cast<void>(strict_json(text, std::min(*builder.syntax_error_at, strict->size()), &at));
        const auto before = text.substr(0, at > 0 ? at - 1 : 0);            // without the unexpected byte, which may be a line break
        const auto above = std::count(before.begin(), before.end(), '\n');  // lines of `text` above the error
        const auto column = at - (above > 0 ? before.rfind('\n') + 1 : 0);
        return bad_input("this JSON is not valid: unexpected text or end here",
                         {lines_.path(), std::max(line, 1L) + static_cast<long>(above), static_cast<long>(column)});
    }

    /// Appends the scalars in `value` to fields_. `name` is the path of `value` in its record, "" for the record itself.
    void flatten(const std::string& name, const OrderedJson& value) {
        if (value.is_object()) {
            for (const auto& [key, member] : value.items()) flatten(name.empty() ? key : name + "." + key, member);
        } else if (value.is_array()) {
            std::size_t k = 0;
            for (const auto& member : value) flatten(fmt::format("{}{}{}", name, name.empty() ? "ch" : ".", ++k), member);
        } else {
            fields_.push_back({name.empty() ? "ch1" : name, &value});
        }
    }

    /// Passes a record to on_record_. `line` is its line number, or 0.
    Result<void> emit_record(const OrderedJson& record, long line) {
        fields_.clear();
        flatten("", record);
        return on_record_(fields_, line);
    }

    Result<void> emit_records(const OrderedJson& list) {
        for (const auto& record : list) TRY(emit_record(record, 0));
        return {};
    }

    /// {"columns": [...], "data": [[...]]}, as pandas writes it with orient="split".
    Result<void> emit_split_records(const OrderedJson& names, const OrderedJson& data) {
        for (const auto& row : data) {
            if (!row.is_array() || row.size() != names.size())
                return error_at(fmt::format("a row of 'data' does not have the {} fields of 'columns'", names.size()));
            fields_.clear();
            for (std::size_t c = 0; c < names.size(); ++c)
                flatten(names[c].is_string() ? names[c].get<std::string>() : names[c].dump(), row[c]);
            TRY(on_record_(fields_, 0));
        }
        return {};
    }

    struct JsonColumn {
        std::string name;
        std::vector<const OrderedJson*> values;
    };

    /// True for a non-empty array or object of scalars.
    static bool is_list(const OrderedJson& j) {
        return (j.is_array() || j.is_object()) && !j.empty() &&
               std::all_of(j.begin(), j.end(), [](const OrderedJson& v) { return !v.is_structured(); });
    }

    /// Finds the lists of scalars in an object and in the objects inside it. Each list is a column, named by its path.
    void find_columns(const std::string& name, const OrderedJson& object, std::vector<JsonColumn>& out) const {
        for (const auto& [key, member] : object.items()) {
            const auto full = name.empty() ? key : name + "." + key;
            if (member.is_array() ? is_list(member)
                                  : is_list(member) && member.contains("0")) {  // pandas writes a column as {"0": ..., "1": ...}
                out.push_back({full, {}});
                for (const auto& v : member) out.back().values.push_back(&v);
            } else if (member.is_object()) {
                find_columns(full, member, out);
            }
        }
    }

    /// Reads the rate and the unit among the members of the document, outside its table.
    void read_metadata(const OrderedJson& object) {
        for (const auto& [key, value] : object.items()) {
            if (value.is_number() && is_rate_name(key) && value.get<double>() > 0 && std::isfinite(value.get<double>()))
                metadata_->rate = value.get<double>();
            if (value.is_string() && (key == "unit" || key == "units") && is_unit(value.get<std::string>()))
                metadata_->unit = value.get<std::string>();
        }
    }

    /// Removes lists without numbers whose length differs from that of the first list with numbers, because they do not belong to the
    /// table.
    void exclude_unrelated_lists(std::vector<JsonColumn>& columns) const {
        const auto has_numbers = [](const JsonColumn& c) {
            return std::any_of(c.values.begin(), c.values.end(), [](const OrderedJson* v) { return v->is_number(); });
        };
        const auto numbers = std::find_if(columns.begin(), columns.end(), has_numbers);
        if (numbers == columns.end()) return;
        const auto rows = numbers->values.size();
        std::erase_if(columns, [&](const JsonColumn& c) {
            const bool is_unrelated = c.values.size() != rows && !has_numbers(c);
            if (is_unrelated && metadata_)
                metadata_->notes.push_back(
                    fmt::format("'{}' was ignored: it has {} strings, but the table has {} rows", c.name, c.values.size(), rows));
            return is_unrelated;
        });
    }

    /// Passes on the records of an object of columns.
    Result<void> emit_columns(const OrderedJson& object) {
        std::vector<JsonColumn> columns;
        find_columns("", object, columns);
        if (columns.empty())
            return error_at(
                "no table in this JSON; expected one record on each line, a list of records, or an object of lists of equal length");
        exclude_unrelated_lists(columns);
        const auto rows = columns[0].values.size();
        for (const auto& c : columns)
            if (c.values.size() != rows)
                return error_at(fmt::format("'{}' has {} values and '{}' has {}: the columns of a table must have equal lengths",
                                            columns[0].name, rows, c.name, c.values.size()));
        for (std::size_t r = 0; r < rows; ++r) {
            fields_.clear();
            for (const auto& c : columns) fields_.push_back({c.name, c.values[r]});
            TRY(on_record_(fields_, 0));
        }
        return {};
    }

    /// Passes on the records of a document. A list is a list of records. In an object, the table is `columns` and `data` if it has both,
    /// otherwise its only list if the elements of that are objects or lists, otherwise its lists of scalars, which are the columns.
    Result<void> emit_document(const OrderedJson& all) {
        if (all.is_array()) return emit_records(all);
        if (!all.is_object()) return error_at("no table in this JSON: it holds a single value");
        if (metadata_) read_metadata(all);
        if (all.contains("columns") && all["columns"].is_array() && all.contains("data") && all["data"].is_array())
            return emit_split_records(all["columns"], all["data"]);
        const OrderedJson* records = nullptr;  // the last list whose elements are objects or lists
        std::size_t lists = 0;                 // number of lists that are not empty
        for (const auto& member : all)
            if (member.is_array() && !member.empty()) ++lists, records = member[0].is_structured() ? &member : records;
        return lists == 1 && records ? emit_records(*records) : emit_columns(all);
    }

    /// True if the text has one record on each line: its first line is a complete record, and the next line, if there is one, begins with
    /// the same bracket. A single line is a record only if it is an object of scalars; otherwise it is a document. Rewinds the text.
    Result<bool> are_json_lines() {
        std::string_view line;
        std::string first;
        std::size_t lines = 0;
        bool same_bracket = true;
        while (TRY(lines_.next(line))) {
            const auto text = trimmed(line);
            if (text.empty()) continue;
            if (++lines == 1) {
                first = text;
                continue;
            }
            same_bracket = text.front() == first.front();
            break;
        }
        TRY(lines_.rewind());
        if (lines == 0 || !same_bracket || first.size() > max_document) return false;
        const auto record = parse(first, 1);
        if (!record && record.error().code == ErrorCode::interrupted) return record.error();
        if (!record || !record->is_structured()) return false;
        if (lines > 1) return true;
        return record->is_object() && std::none_of(record->begin(), record->end(), [](const OrderedJson& v) { return v.is_structured(); });
    }

    /// Reads one record from each line.
    Result<void> read_lines() {
        std::string_view line;
        while (TRY(lines_.next(line))) {
            if (trimmed(line).empty()) continue;
            const auto record = TRY(parse(line, lines_.line_number()));
            if (!record.is_structured())
                return error_at("expected a record here, such as {\"time_s\": 0, \"fz_N\": 1}", lines_.line_number());
            TRY(emit_record(record, lines_.line_number()));
        }
        return {};
    }

    /// Reads the complete text as one document.
    Result<void> read_document() {
        std::string text;
        std::string_view line;
        while (TRY(lines_.next(line))) {
            text.append(line) += '\n';
            if (text.size() > max_document)
                return error_at(fmt::format(
                    "the JSON document is larger than {} MB. Convert it to one record on each line, without a limit: python3 -c "
                    "\"import pandas; pandas.read_json('FILE').to_json('FILE.jsonl', orient='records', lines=True)\"",
                    max_document >> 20));
        }
        if (!text.empty()) text.pop_back();  // the last line break, which the file may not have
        const auto all = parse(text, 1);
        return all ? emit_document(*all) : all.error();
    }

public:
    JsonReader(LineReader& lines, const RecordHandler& on_record, const std::function<bool()>& should_continue, JsonMetadata* metadata)
        : lines_(lines), on_record_(on_record), should_continue_(should_continue), metadata_(metadata) {}

    Result<void> read() { return TRY(are_json_lines()) ? read_lines() : read_document(); }
};

}  // namespace

Result<void> read_json_records(LineReader& lines, const std::function<Result<void>(std::span<const JsonField>, long line)>& on_record,
                               const std::function<bool()>& should_continue, JsonMetadata* metadata) {
    return JsonReader(lines, on_record, should_continue, metadata).read();
}

Result<bool> looks_like_json(LineReader& lines) {
    std::string_view line;
    bool json = false;
    while (TRY(lines.next(line))) {
        const auto text = trimmed(line);
        if (text.empty()) continue;
        const auto rest = trimmed(text.substr(1));
        json = text.front() == '{'
                   ? rest.empty() || rest.front() == '"' || rest.front() == '}'
                   : text.front() == '[' && (rest.empty() || std::string_view("{[-0123456789\"").find(rest.front()) != rest.npos);
        break;
    }
    TRY(lines.rewind());
    return json;
}

}  // namespace corpuscle
