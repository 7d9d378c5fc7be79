#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text/ascii_text.hpp"
#include "io/spikes/train_collector.hpp"
#include "io/table/heading.hpp"
#include "io/text/dialect.hpp"
#include "io/text/json_records.hpp"

namespace corpuscle {
namespace {

struct CsvField {
    std::string text;
    long column = 1;  // position of the field in its line, in bytes, counted from 1
};

/// Splits a line into fields. A quoted field may contain separators, and quotes that are written twice. Returns false if a quote is not
/// closed; the last field is then the one with that quote.
bool split(std::string_view line, char separator, std::vector<CsvField>& out) {
    out.clear();
    if (separator == ' ') {
        for (std::size_t at = line.find_first_not_of(" \t"); at < line.size();) {
            const auto end = std::min(line.find_first_of(" \t", at), line.size());
            out.push_back({std::string(line.substr(at, end - at)), static_cast<long>(at) + 1});
            at = line.find_first_not_of(" \t", end);
        }
        return true;
    }
    for (std::size_t at = 0;;) {
        const auto begin = std::min(line.find_first_not_of(separator == '\t' ? " " : " \t", at), line.size());
        CsvField field{"", static_cast<long>(begin) + 1};
        auto end = std::min(line.find(separator, at), line.size());
        if (begin < line.size() && line[begin] == '"') {
            bool open = true;
            std::size_t k = begin + 1;
            for (; open && k < line.size(); ++k) {
                if (line[k] == '"' && !line.substr(k).starts_with("\"\"")) {
                    open = false;
                } else {
                    field.text += line[k];
                    k += line[k] == '"';
                }
            }
            if (open) return out.push_back(std::move(field)), false;
            end = std::min(line.find(separator, k), line.size());
        } else {
            field.text = trimmed(line.substr(at, end - at));
        }
        out.push_back(std::move(field));
        if (end == line.size()) return true;
        at = end + 1;
    }
}

/// Parses a number. If `separator` is not a comma, a comma is read as a decimal point.
bool parse_time(std::string_view text, char separator, double& value) {
    return Dialect{separator, separator != ','}.parse_number(text, value);
}

/// Reads a text table with one row for each spike.
class TextSpikes {
    LineReader lines_;
    SpikeColumns wanted_;
    char separator_ = ',';
    std::vector<CsvField> fields_;  // of the current line
    std::string comment_;           // the last comment before the table, without # or %
    ResolvedSpikeColumns found_;
    std::size_t columns_ = 0;  // number of columns; 0 until the first line of the table is read
    TrainCollector trains_;

    /// An error in the current line; `column` as in CsvField, 0: not known.
    Error error_at(std::string message, long column = 0) const {
        return bad_input(std::move(message), {lines_.path(), lines_.line_number(), column});
    }

    /// The separator of a line: a tab, otherwise a semicolon, otherwise a comma, otherwise blanks. Blanks are the separator only if the
    /// line begins with a number or with a name of the time, because other names may contain blanks.
    static char separator_of(std::string_view line) {
        for (const char c : {'\t', ';', ','})
            if (line.find(c) != line.npos) return c;
        std::vector<CsvField> fields;
        double value;
        split(line, ' ', fields);
        const bool blanks =
            fields.size() > 1 && (parse_time(fields[0].text, ' ', value) || is_time_name(parse_heading(fields[0].text).name));
        return blanks ? ' ' : ',';
    }

    /// Reads the next line that is neither empty nor a comment, and splits it. Returns false at the end of the file.
    Result<bool> next() {
        std::string_view line;
        for (;;) {
            const auto more = lines_.next(line);
            if (!more || !*more) return more;
            const auto content = trimmed(line);
            if (content.empty()) continue;
            if (content.front() != '#' && content.front() != '%') break;
            if (columns_ == 0) comment_ = trimmed(content.substr(1));
        }
        if (columns_ == 0) separator_ = separator_of(line);
        if (!split(line, separator_, fields_)) return error_at("a quote is opened here but not closed", fields_.back().column);
        return true;
    }

    /// Finds the columns. fields_ is the first line of the table, which is the header unless all its fields are numbers. If they are, the
    /// comment above the line is the header if it has as many fields. Returns true if the first line is a row of the table.
    Result<bool> read_header() {
        columns_ = fields_.size();
        double value;
        const bool row =
            std::all_of(fields_.begin(), fields_.end(), [&](const CsvField& f) { return parse_time(f.text, separator_, value); });
        std::vector<std::string> headings;
        for (const auto& f : fields_) headings.push_back(row ? "" : f.text);
        std::vector<CsvField> commented;
        if (row && !comment_.empty() && split(comment_, separator_of(comment_), commented) && commented.size() == columns_)
            for (std::size_t c = 0; c < columns_; ++c) headings[c] = commented[c].text;
        if (row && columns_ > 1 && headings[0].empty() && !(wanted_.time && wanted_.train))
            return error_at(
                fmt::format("{} columns without a header; select the columns of times and trains, such as --time 1 --train 2", columns_));
        std::size_t column = 0;
        const auto found = find_spike_columns(headings, wanted_, column);
        if (!found) return error_at(found.error().message, column > 0 ? fields_[column - 1].column : 0);
        found_ = *found;
        return row;
    }

    /// Adds the spike in the current line.
    Result<void> add_row() {
        if (fields_.size() != columns_) return error_at(fmt::format("{} columns where {} are expected", fields_.size(), columns_));
        const auto& [text, column] = fields_[found_.time];
        double t = 0;
        if (!parse_time(text, separator_, t) || !std::isfinite(t * found_.seconds_per_unit))
            return error_at(fmt::format("'{}' where a time is expected", text.substr(0, 40)), column);
        const auto field_text = [this](const std::optional<std::size_t>& c) { return c ? fields_[*c].text : std::string(); };
        trains_.train(field_text(found_.afferent), field_text(found_.channel)).push_back(t * found_.seconds_per_unit);
        return {};
    }

public:
    TextSpikes(LineReader lines, SpikeColumns wanted) : lines_(std::move(lines)), wanted_(std::move(wanted)) {}

    Result<std::vector<NamedTrain>> read() {
        if (!TRY(next())) return bad_input("the file has no header and no spikes", {lines_.path()});
        if (TRY(read_header())) TRY(add_row());
        while (TRY(next())) TRY(add_row());
        return std::move(trains_).sorted();
    }
};

/// A JSON value as the name of an afferent or channel.
std::string word_of(const nlohmann::ordered_json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// Reads JSON with one record for each spike. The first record defines the columns.
Result<std::vector<NamedTrain>> read_json_spikes(LineReader& lines, const SpikeColumns& wanted) {
    std::vector<std::string> headings;  // the names of the fields of the first record
    ResolvedSpikeColumns found;
    TrainCollector trains;
    const auto add = [&](std::span<const JsonField> fields, long line) -> Result<void> {
        const auto error_here = [&](std::string message) { return bad_input(std::move(message), {lines.path(), line}); };
        if (headings.empty()) {
            for (const auto& f : fields) headings.push_back(f.name == "ch1" && fields.size() == 1 ? "" : f.name);
            std::size_t column = 0;
            const auto columns = find_spike_columns(headings, wanted, column);
            if (!columns) return error_here(columns.error().message);
            found = *columns;
        }
        if (fields.size() != headings.size())
            return error_here(fmt::format("{} fields where {} are expected", fields.size(), headings.size()));
        const auto& time = *fields[found.time].value;
        const double t = time.is_number() ? time.get<double>() * found.seconds_per_unit : std::nan("");
        if (!std::isfinite(t)) return error_here(fmt::format("{} where a time is expected", time.dump(-1, ' ', true).substr(0, 40)));
        const auto field_text = [&](const std::optional<std::size_t>& c) { return c ? word_of(*fields[*c].value) : std::string(); };
        trains.train(field_text(found.afferent), field_text(found.channel)).push_back(t);
        return {};
    };
    TRY(read_json_records(lines, add));
    return std::move(trains).sorted();
}

}  // namespace

Result<std::vector<NamedTrain>> read_text_spikes(const std::string& path, const SpikeColumns& wanted) {
    auto lines = TRY(LineReader::open(path));
    if (TRY(looks_like_json(lines))) return read_json_spikes(lines, wanted);
    return TextSpikes(std::move(lines), wanted).read();
}

}  // namespace corpuscle
