#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/dialect.hpp"
#include "io/heading.hpp"
#include "io/json_records.hpp"
#include "io/lines.hpp"
#include "io/spike_columns.hpp"
#include "io/trains.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

struct Field {
    std::string text;
    long column = 1;  // 1-based, in bytes
};

/// A line's fields; quotes may hold separators, and a doubled quote is one. False if a quote is left open.
bool split(std::string_view line, char separator, std::vector<Field>& out) {
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
        Field field{"", static_cast<long>(begin) + 1};
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

bool is_time(std::string_view text, char separator, double& value) { return Dialect{separator, separator != ','}.number(text, value); }

/// A table of text with a row a spike.
class TextSpikes {
    Lines lines_;
    SpikeColumns wanted_;
    char separator_ = ',';
    std::vector<Field> fields_;
    std::string comment_;  // the last before the table
    SpikeColumnsFound found_;
    std::size_t columns_ = 0;
    Trains trains_;

    Error at(std::string sentence, long column = 0) const {
        return bad_input(std::move(sentence), {lines_.path(), lines_.number(), column});
    }

    /// Blanks separate only numbers, or names of which the first is the time: other names may hold some.
    static char separator_of(std::string_view line) {
        for (const char c : {'\t', ';', ','})
            if (line.find(c) != line.npos) return c;
        std::vector<Field> fields;
        double value;
        split(line, ' ', fields);
        const bool blanks = fields.size() > 1 && (is_time(fields[0].text, ' ', value) || names_time(parse_heading(fields[0].text).name));
        return blanks ? ' ' : ',';
    }

    /// The next line that is not empty or a comment, in fields.
    Result<bool> next() {
        std::string_view line;
        for (;;) {
            const auto more = lines_.next(line);
            if (!more || !*more) return more;
            const auto plain = trimmed(line);
            if (plain.empty()) continue;
            if (plain.front() != '#' && plain.front() != '%') break;
            if (columns_ == 0) comment_ = trimmed(plain.substr(1));
        }
        if (columns_ == 0) separator_ = separator_of(line);
        if (!split(line, separator_, fields_)) return at("a quote that is opened here does not end", fields_.back().column);
        return true;
    }

    /// Headings in the first line, or in a comment above numbers, or none. True if the first line is a row.
    Result<bool> read_header() {
        columns_ = fields_.size();
        double value;
        const bool row = std::all_of(fields_.begin(), fields_.end(), [&](const Field& f) { return is_time(f.text, separator_, value); });
        std::vector<std::string> headings;
        for (const auto& f : fields_) headings.push_back(row ? "" : f.text);
        std::vector<Field> commented;
        if (row && !comment_.empty() && split(comment_, separator_of(comment_), commented) && commented.size() == columns_)
            for (std::size_t c = 0; c < columns_; ++c) headings[c] = commented[c].text;
        if (row && columns_ > 1 && headings[0].empty() && !(wanted_.time && wanted_.unit))
            return at(fmt::format("{} columns without a header; --time 1 --unit 2 says which hold the times and the units", columns_));
        std::size_t column = 0;
        const auto found = find_spike_columns(headings, wanted_, column);
        if (!found) return at(found.error().sentence, column > 0 ? fields_[column - 1].column : 0);
        found_ = *found;
        return row;
    }

    Result<void> add_row() {
        if (fields_.size() != columns_) return at(fmt::format("{} columns where {} should be", fields_.size(), columns_));
        const auto& [text, column] = fields_[found_.time];
        double t = 0;
        if (!is_time(text, separator_, t) || !std::isfinite(t * found_.seconds))
            return at(fmt::format("'{}' where a time should be", text.substr(0, 40)), column);
        const auto word = [this](const std::optional<std::size_t>& c) { return c ? fields_[*c].text : std::string(); };
        trains_.of(word(found_.afferent), word(found_.channel)).push_back(t * found_.seconds);
        return {};
    }

public:
    TextSpikes(Lines lines, SpikeColumns wanted) : lines_(std::move(lines)), wanted_(std::move(wanted)) {}

    Result<std::vector<NamedTrain>> read() {
        const auto header = next();
        if (!header) return header.error();
        if (!*header) return bad_input("no header and no spikes in this file", {lines_.path()});
        const auto row = read_header();
        if (!row) return row.error();
        if (*row)
            if (auto ok = add_row(); !ok) return ok.error();
        for (;;) {
            const auto more = next();
            if (!more) return more.error();
            if (!*more) return std::move(trains_).in_order();
            if (auto ok = add_row(); !ok) return ok.error();
        }
    }
};

/// JSON with a record a spike, as our own events are.
class JsonSpikes {
    Lines& lines_;
    SpikeColumns wanted_;
    std::vector<std::string> headings_;
    SpikeColumnsFound found_;
    Trains trains_;

    static std::string word_of(const nlohmann::ordered_json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

    Result<void> add(std::span<const JsonField> fields, long line) {
        const auto wrong = [&](std::string sentence) { return bad_input(std::move(sentence), {lines_.path(), line}); };
        if (headings_.empty()) {
            for (const auto& f : fields) headings_.push_back(f.name == "ch1" && fields.size() == 1 ? "" : f.name);
            std::size_t column = 0;
            const auto found = find_spike_columns(headings_, wanted_, column);
            if (!found) return wrong(found.error().sentence);
            found_ = *found;
        }
        if (fields.size() != headings_.size()) return wrong(fmt::format("{} fields where {} should be", fields.size(), headings_.size()));
        const auto& time = *fields[found_.time].value;
        const double t = time.is_number() ? time.get<double>() * found_.seconds : std::nan("");
        if (!std::isfinite(t)) return wrong(fmt::format("{} where a time should be", time.dump(-1, ' ', true).substr(0, 40)));
        const auto word = [&](const std::optional<std::size_t>& c) { return c ? word_of(*fields[*c].value) : std::string(); };
        trains_.of(word(found_.afferent), word(found_.channel)).push_back(t);
        return {};
    }

public:
    JsonSpikes(Lines& lines, SpikeColumns wanted) : lines_(lines), wanted_(std::move(wanted)) {}

    Result<std::vector<NamedTrain>> read() {
        if (auto ok = read_json_records(lines_, [this](auto fields, long line) { return add(fields, line); }); !ok) return ok.error();
        return std::move(trains_).in_order();
    }
};

}  // namespace

Result<std::vector<NamedTrain>> read_text_spikes(const std::string& path, const SpikeColumns& wanted) {
    auto lines = Lines::open(path);
    if (!lines) return lines.error();
    const auto json = begins_like_json(*lines);
    if (!json) return json.error();
    if (*json) return JsonSpikes(*lines, wanted).read();
    return TextSpikes(std::move(*lines), wanted).read();
}

}  // namespace corpuscle
