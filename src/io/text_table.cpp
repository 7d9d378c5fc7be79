#include "io/text_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/dialect.hpp"
#include "io/utf8.hpp"
#include "signal/quantity.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

bool is_comment(std::string_view line) {
    const auto s = trimmed(line);
    return s.empty() || s.front() == '#' || s.front() == '%';
}

/// What may stand behind the last '_' of a heading and be a unit; not a letter that more often means something else (left_F).
bool known_unit(std::string_view s) {
    constexpr std::string_view words[] = {"counts", "count",  "raw",  "adc",    "lsb",    "deg",     "degC",   "kg",
                                          "g",      "Pa",     "kPa",  "mmHg",   "bar",    "psi",     "sec",    "seconds",
                                          "msec",   "millis", "usec", "micros", "newton", "newtons", "Newton", "Newtons"};
    constexpr std::string_view letters[] = {"", "1", "%", "F", "A", "S", "T"};
    if (std::find(std::begin(letters), std::end(letters), s) != std::end(letters)) return false;
    return std::find(std::begin(words), std::end(words), s) != std::end(words) || parse_unit(s);
}

class TextTable final : public Table {
    Lines lines_;
    Dialect dialect_;
    std::vector<Column> columns_;
    std::optional<std::size_t> time_;
    bool header_ = false, commented_ = false, skip_header_ = false;
    std::string comment_;  // the last before the data
    Fields fields_;
    std::vector<long> numbers_;   // line numbers of the last block's rows
    std::vector<double*> to_;     // of each column: where its block of numbers goes, or nowhere
    std::size_t wanted_end_ = 0;  // behind the last column wanted

    Error at(std::string sentence, long column = 0) const {
        return bad_input(std::move(sentence), {lines_.path(), lines_.number(), column});
    }

    std::string called(std::size_t c) const {
        return header_ || commented_ ? fmt::format("'{}'", columns_[c].name) : fmt::format("{}", c + 1);
    }

    /// The next line that holds data.
    Result<bool> next_row(std::string_view& line) {
        for (;;) {
            const auto more = lines_.next(line);
            if (!more || !*more) return more;
            if (is_comment(line)) {
                if (columns_.empty()) comment_ = trimmed(trimmed(line).substr(trimmed(line).empty() ? 0 : 1));
                continue;
            }
            if (!std::exchange(skip_header_, false)) return true;
        }
    }

    Result<double> number_in(std::string_view line, std::size_t c) const {
        double value = 0;
        if (dialect_.number(fields_[c], value)) return value;
        if (gaps_allowed_) return std::numeric_limits<double>::quiet_NaN();
        const auto column = fields_[c].data() - line.data() + 1;
        const auto what = fields_[c].empty() ? std::string("nothing") : fmt::format("'{}'", fields_[c].substr(0, 40));
        return at(fmt::format("column {}: {} where a number should be", called(c), what), column);
    }

    /// The first line that is no comment: a header, or data under a commented header or none.
    void read_header(std::string_view line) {
        dialect_ = Dialect::of(line);
        split(line);
        double value;
        header_ = std::any_of(fields_.begin(), fields_.end(), [&](auto f) { return !f.empty() && !dialect_.number(f, value, true); });
        const std::size_t columns = fields_.size();
        if (!header_ && !comment_.empty()) {  // numpy's savetxt, and others, write the header as a comment
            Dialect::of(comment_).split(comment_, fields_);
            commented_ = fields_.size() == columns;
        }
        for (std::size_t c = 0; c < columns; ++c) columns_.push_back(header_ || commented_ ? parse_heading(fields_[c]) : Column{});
        for (std::size_t c = columns; c-- > 0;)
            if (names_time(columns_[c].name)) time_ = c;
    }

    /// A separator at the end of a line makes no column.
    void split(std::string_view line) {
        dialect_.split(line, fields_);
        if (fields_.size() > 1 && fields_.back().empty() && (columns_.empty() || fields_.size() == columns_.size() + 1)) fields_.pop_back();
    }

    /// Without a header: does the first column rise by like steps over the first rows?
    Result<void> look_for_time() {
        std::vector<std::vector<double>> first(1);
        const auto rows = read({0}, 64, first);
        if (!rows) return rows.error();
        const auto& t = first[0];
        if (*rows >= 3 && columns_.size() > 1) {
            const double mean = (t[*rows - 1] - t[0]) / static_cast<double>(*rows - 1);
            bool even = mean > 0;
            for (std::size_t k = 1; k < *rows; ++k) even = even && t[k] > t[k - 1] && std::abs(t[k] - t[k - 1] - mean) < 0.5 * mean;
            if (even) time_ = 0;
        }
        return rewind();
    }

    void set_columns(const std::vector<std::size_t>& wanted, std::vector<std::vector<double>>& out) {
        to_.assign(columns_.size(), nullptr);
        for (std::size_t i = 0; i < wanted.size(); ++i) to_[wanted[i]] = out[i].data();
        wanted_end_ = wanted.empty() ? 0 : *std::max_element(wanted.begin(), wanted.end()) + 1;
    }

    /// Whether what is left of a line holds so many fields, none of them in quotes or empty at the end.
    bool ends_after(const char* p, const char* end, std::size_t fields) const {
        const auto left = static_cast<std::size_t>(end - p);
        return left > 0 && end[-1] != dialect_.separator && !std::memchr(p, '"', left) &&
               static_cast<std::size_t>(std::count(p, end, dialect_.separator)) + 1 == fields;
    }

    /// A line as most are, read in one go; false if it needs a closer look.
    bool read_plain_row(std::string_view line, std::size_t row) const {
        const char *p = line.data(), *const end = p + line.size();
        const char separator = dialect_.separator;
        for (std::size_t c = 0; c < to_.size(); ++c) {
            if (c > 0) {
                if (p == end) return false;
                ++p;
            }
            if (c == wanted_end_ && separator != ' ') return ends_after(p, end, to_.size() - c);
            if (!to_[c] && separator != ' ') {
                while (p < end && *p != separator && *p != '"') ++p;
                if (p < end && *p == '"') return false;
                continue;
            }
            double value;
            if (!dialect_.plain_number(p, end, value)) return false;
            if (to_[c]) to_[c][row] = value;
        }
        return p == end;
    }

    Result<void> read_row(std::string_view line, std::size_t row, const std::vector<std::size_t>& wanted,
                          std::vector<std::vector<double>>& out) {
        if (read_plain_row(line, row)) return {};
        split(line);
        if (fields_.size() != columns_.size()) {
            if (!gaps_allowed_) return at(fmt::format("{} columns where {} should be", fields_.size(), columns_.size()));
            for (auto& column : out) column[row] = std::numeric_limits<double>::quiet_NaN();  // which is which nobody knows
            return {};
        }
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const auto value = number_in(line, wanted[i]);
            if (!value) return value.error();
            out[i][row] = *value;
        }
        return {};
    }

    void name_columns() {
        std::size_t number = 0;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            if (time_ == c) {
                if (columns_[c].name.empty()) columns_[c].name = "time";
                continue;
            }
            ++number;
            if (columns_[c].name.empty()) columns_[c].name = fmt::format("ch{}", number);
        }
    }

public:
    explicit TextTable(Lines lines) : lines_(std::move(lines)) {}

    Result<void> open() {
        std::string_view line;
        const auto first = next_row(line);
        if (!first) return first.error();
        if (!*first) return bad_input("no data in this file", {lines_.path()});
        if (line.find('\0') != std::string_view::npos) return at("this is no text: it has NUL bytes (a binary file, or UTF-16?)");
        read_header(line);
        if (auto ok = rewind(); !ok) return ok;
        if (!header_ && !commented_)
            if (auto ok = look_for_time(); !ok) return ok;
        name_columns();
        return {};
    }

    const std::vector<Column>& columns() const override { return columns_; }
    std::optional<std::size_t> time_column() const override { return time_; }
    bool time_is_guessed() const override { return time_ && !header_ && !commented_; }
    double done() const override { return lines_.done(); }
    Place place(std::size_t row) const override { return {lines_.path(), row < numbers_.size() ? numbers_[row] : 0}; }

    Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) override {
        for (auto& column : out) column.resize(rows);
        numbers_.clear();
        set_columns(wanted, out);
        std::size_t row = 0;
        for (std::string_view line; row < rows; ++row) {
            const auto more = next_row(line);
            if (!more) return more.error();
            if (!*more) break;
            if (auto ok = read_row(line, row, wanted, out); !ok) return ok.error();
            numbers_.push_back(lines_.number());
        }
        return row;
    }

    Result<void> rewind() override {
        skip_header_ = header_;
        return lines_.rewind();
    }
};

}  // namespace

bool names_time(std::string_view name) {
    const auto word = lower(name);
    return word == "time" || word == "timestamp" || word == "t" || word == "times" || word == "timestamps" || word == "time stamp";
}

Column parse_heading(std::string_view written) {
    auto text = utf8_text(written);
    for (std::size_t at = 0; (at = text.find("\"\"", at)) != text.npos; ++at) text.erase(at, 1);  // a quote within quotes
    const std::string_view field = text;
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}})
        if (const auto at = field.rfind(open); at != std::string_view::npos && field.ends_with(close) && at > 0)
            return {std::string(trimmed(field.substr(0, at))), std::string(trimmed(field.substr(at + 1, field.size() - at - 2)))};
    if (const auto at = field.rfind('_'); at != std::string_view::npos && at > 0 && known_unit(field.substr(at + 1)))
        return {std::string(field.substr(0, at)), std::string(field.substr(at + 1))};
    return {std::string(field), ""};
}

Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& options) {
    if (options.dataset) return bad_usage(fmt::format("--dataset {}: a file of text has only one table", *options.dataset));
    auto lines = Lines::open(path);
    if (!lines) return lines.error();
    auto table = std::make_unique<TextTable>(std::move(*lines));
    if (auto ok = table->open(); !ok) return ok.error();
    return std::unique_ptr<Table>(std::move(table));
}

}  // namespace corpuscle
