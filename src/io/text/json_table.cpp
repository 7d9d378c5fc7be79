#include "io/text/json_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "io/table/column_roles.hpp"
#include "io/text/json_records.hpp"
#include "io/text/time_stamp.hpp"

namespace corpuscle {
namespace {

// Upper bounds on a table, which is kept in memory: numbers in all columns (one gigabyte), and columns.
constexpr std::size_t max_json_numbers = std::size_t{1} << 27, max_json_columns = std::size_t{1} << 17;

class JsonTable final : public Table {
    /// The values of one column.
    struct Values {
        std::vector<double> numbers;     // for each record; NaN if its field is missing or not a number
        FirstFields first;               // of the inspected records
        std::optional<TimeStamp> stamp;  // the first time stamp of the column
    };
    std::string path_;
    std::vector<Column> columns_;
    std::vector<Values> values_;                                   // for each column
    std::unordered_map<std::string, std::size_t> column_indices_;  // by the name of the field
    std::vector<long> lines_;                                      // line number of each record for JSON lines; empty for a document
    ColumnRoles roles_;
    JsonMetadata metadata_;
    std::size_t rows_ = 0, numbers_ = 0;  // number of records, and of values in all columns
    std::size_t next_ = 0, block_ = 0;    // next row to read, first row of the last block

    static constexpr double missing = std::numeric_limits<double>::quiet_NaN();

    Error error_at(std::string message, long line) const { return bad_input(std::move(message), {path_, line}); }

    /// The number that a string stands for. It is a number in quotes, or a time stamp, in seconds from the first one of the column. NaN for
    /// other words. Counts the field in `first` unless this is null.
    double number_of(const std::string& word, Values& v, FirstFields* first) {
        double x = 0;
        const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), x);
        if (status == std::errc{} && end == word.data() + word.size() && !word.empty()) {
            if (first) first->add_number(x);
            return x;
        }
        const auto stamp = parse_time_stamp(word);
        if (first) first->add_other(stamp ? first->stamp_count : first->word_count);
        if (!stamp) return missing;
        if (!v.stamp) v.stamp = stamp;
        return seconds_between(*v.stamp, *stamp);
    }

    /// The number that a field of the next record stands for, or NaN.
    double number_of(const nlohmann::ordered_json& value, Values& v) {
        FirstFields* const first = rows_ < inspected_rows ? &v.first : nullptr;
        if (value.is_string()) return number_of(value.get_ref<const std::string&>(), v, first);
        const double x = value.is_number() ? value.get<double>() : missing;
        if (first) std::isnan(x) ? first->add_other(value.is_boolean() ? first->word_count : first->empty_count) : first->add_number(x);
        return x;
    }

    /// Adds a record. A column without a field in the record is filled with NaN when its next field comes, or at the end.
    Result<void> add(std::span<const JsonField> fields, long line) {
        for (const auto& f : fields) {
            const auto [at, is_new] = column_indices_.try_emplace(f.name, columns_.size());
            if (is_new) {
                if (columns_.size() == max_json_columns)
                    return error_at(fmt::format("the table has more than {} columns", max_json_columns), line);
                columns_.push_back(parse_heading(f.name));
                values_.emplace_back();
            }
            auto& v = values_[at->second];
            if (v.numbers.size() > rows_) return error_at(fmt::format("'{}' occurs twice in one record", f.name), line);
            numbers_ += rows_ + 1 - v.numbers.size();
            if (numbers_ > max_json_numbers)
                return error_at("the table is too large for memory; save it as CSV, which is read in blocks", line);
            v.numbers.resize(rows_, missing);
            for (std::size_t k = v.first.numbers.size(); k < std::min(rows_, inspected_rows); ++k) v.first.add_other(v.first.empty_count);
            v.numbers.push_back(number_of(*f.value, v));
        }
        ++rows_;
        if (line > 0) lines_.push_back(line);
        return {};
    }

public:
    explicit JsonTable(std::string path) : path_(std::move(path)) {}

    Result<void> open(LineReader& lines, const std::function<bool()>& should_continue) {
        const auto on_record = [this, &should_continue](auto fields, long line) {
            if (rows_ % rows_per_block == 0 && !should_continue()) return Result<void>(Error{ErrorCode::interrupted, "interrupted"});
            return add(fields, line);
        };
        TRY(read_json_records(lines, on_record, should_continue, &metadata_));
        if (rows_ == 0 || columns_.empty()) return bad_input("no data in this file", {path_});
        if (rows_ > max_json_numbers / columns_.size())
            return bad_input("the table is too large for memory; save it as CSV, which is read in blocks", {path_});
        std::vector<FirstFields> first;
        for (auto& v : values_) {
            v.numbers.resize(rows_, missing);
            for (std::size_t k = v.first.numbers.size(); k < std::min(rows_, inspected_rows); ++k) v.first.add_other(v.first.empty_count);
            first.push_back(std::move(v.first));
        }
        roles_ = assign_roles(columns_, first, has_named_columns(columns_));
        for (std::size_t c = 0; c < columns_.size(); ++c)
            if (columns_[c].unit.empty() && columns_[c].exclusion_reason.empty() && c != roles_.time_column)
                columns_[c].unit = metadata_.unit;
        if (roles_.time_column && columns_[*roles_.time_column].holds_time_stamps) {
            const auto& s = *values_[*roles_.time_column].stamp;
            const auto instant = format_instant(static_cast<double>(s.day) * 86'400 + static_cast<double>(s.nanoseconds) * 1e-9);
            roles_.notes.push_back(fmt::format("0 s is {}, the first time in '{}'", s.has_date ? instant : instant.substr(11),
                                               columns_[*roles_.time_column].name));
        }
        return {};
    }

    const std::vector<Column>& columns() const override { return columns_; }
    std::optional<std::size_t> time_column() const override { return roles_.time_column; }
    bool is_time_guessed() const override { return roles_.is_time_guessed; }
    std::optional<double> rate() const override { return metadata_.rate; }
    std::vector<std::string> notes() const override { return metadata_.notes; }
    std::vector<std::string> time_notes() const override { return roles_.notes; }
    double progress() const override { return rows_ > 0 ? static_cast<double>(next_) / static_cast<double>(rows_) : 1; }
    Result<void> rewind() override { return next_ = 0, Result<void>{}; }
    SourceLocation location(std::size_t row) const override {
        const auto at = block_ + row;
        if (at < lines_.size()) return {path_, lines_[at]};
        return {fmt::format("{}: record {}", path_, at + 1)};  // in a document, line numbers do not identify records
    }

    Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) override {
        const auto count = std::min(rows, rows_ - next_);
        block_ = next_;
        for (auto& column : out) column.resize(count);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const auto from = values_[wanted[i]].numbers.begin() + static_cast<std::ptrdiff_t>(next_);
            std::copy_n(from, count, out[i].begin());
            const auto bad = std::find_if_not(out[i].begin(), out[i].end(), [](double x) { return std::isfinite(x); });
            if (bad == out[i].end()) continue;
            const auto row = static_cast<std::size_t>(bad - out[i].begin());
            if (!allows_gaps_)
                return bad_input(
                    fmt::format("record {}: '{}' is not a number; use --bad-fields interpolate to fill it in, or --bad-fields drop to "
                                "skip the record",
                                next_ + row + 1, columns_[wanted[i]].name),
                    lines_.empty() ? SourceLocation{path_} : location(row));
            std::replace_if(out[i].begin(), out[i].end(), [](double x) { return std::isinf(x); }, missing);
        }
        next_ += count;
        return count;
    }
};

}  // namespace

Result<std::unique_ptr<Table>> open_json_table(LineReader lines, const std::function<bool()>& should_continue) {
    auto table = std::make_unique<JsonTable>(lines.path());
    TRY(table->open(lines, should_continue));
    return std::unique_ptr<Table>(std::move(table));
}

}  // namespace corpuscle
