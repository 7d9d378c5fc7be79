#include "io/text/json_records.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "core/text/ascii_text.hpp"
#include "io/recording/samples.hpp"
#include "io/text/time_stamp.hpp"

namespace corpuscle {
namespace {

// Upper bounds on a table, which is kept in memory: numbers in all columns (one gigabyte), and columns.
constexpr std::size_t max_json_numbers = std::size_t{1} << 27, max_json_columns = std::size_t{1} << 17;

class JsonSamples final : public Samples {
    /// The values of one column.
    struct Values {
        std::vector<double> numbers;     // for each record; NaN if its field is missing or not a number
        FirstFields first;               // of the inspected records
        std::optional<TimeStamp> stamp;  // the first time stamp of the column
    };
    std::string path_;
    std::vector<Values> values_;                                   // for each column
    std::unordered_map<std::string, std::size_t> column_indices_;  // by the name of the field
    std::vector<long> lines_;                                      // line number of each record for JSON lines; empty for a document
    JsonMetadata metadata_;
    std::size_t rows_ = 0, numbers_ = 0;  // number of records, and of values in all columns

    static constexpr double missing = std::numeric_limits<double>::quiet_NaN();

    Error error_at(std::string message, long line) const { return bad_input(std::move(message), {path_, line}); }

    /// The number that a string stands for. It is a number in quotes, or a time stamp, in seconds from the first one of the column. NaN for
    /// other words. Counts the field in `first` unless this is null.
    double number_of(const std::string& word, Values& v, FirstFields* first) {
        if (const auto x = parse_bare_number<double>(word)) {
            if (first) first->add_number(*x);
            return *x;
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
            const auto [at, is_new] = column_indices_.try_emplace(f.name, info_.columns.size());
            if (is_new) {
                if (info_.columns.size() == max_json_columns)
                    return error_at(fmt::format("the table has more than {} columns", max_json_columns), line);
                info_.columns.push_back(parse_heading(f.name));
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
    explicit JsonSamples(std::string path) : path_(std::move(path)) {}

    Result<void> open(LineReader& lines, const std::function<bool()>& should_continue) {
        const auto on_record = [this, &should_continue](auto fields, long line) {
            if (rows_ % rows_per_block == 0 && !should_continue()) return Result<void>(interrupted_error());
            return add(fields, line);
        };
        TRY(read_json_records(lines, on_record, should_continue, &metadata_));
        if (rows_ == 0 || info_.columns.empty()) return bad_input("no data in this file", {path_});
        if (rows_ > max_json_numbers / info_.columns.size())
            return bad_input("the table is too large for memory; save it as CSV, which is read in blocks", {path_});
        std::vector<FirstFields> first;
        for (auto& v : values_) {
            v.numbers.resize(rows_, missing);
            for (std::size_t k = v.first.numbers.size(); k < std::min(rows_, inspected_rows); ++k) v.first.add_other(v.first.empty_count);
            first.push_back(std::move(v.first));
        }
        auto roles = assign_roles(info_.columns, first, has_named_columns(info_.columns));
        info_.time_column = roles.time_column, info_.is_time_guessed = roles.is_time_guessed, info_.time_notes = std::move(roles.notes);
        info_.has_roles = true;
        for (std::size_t c = 0; c < info_.columns.size(); ++c)
            if (info_.columns[c].unit.empty() && info_.columns[c].exclusion_reason.empty() && c != info_.time_column)
                info_.columns[c].unit = metadata_.unit;
        if (const auto time = info_.time_column; time && info_.columns[*time].holds_time_stamps)
            info_.time_notes.push_back(origin_note(*values_[*time].stamp, info_.columns[*time].name));
        info_.rows = static_cast<std::int64_t>(rows_), info_.is_orientation_known = false;
        info_.rate = metadata_.rate, info_.notes = std::move(metadata_.notes);
        return {};
    }

    SourceLocation location(std::int64_t row, const std::string& path) const override {
        const auto at = static_cast<std::size_t>(row);
        if (at < lines_.size()) return {path, lines_[at]};
        return {fmt::format("{}: record {}", path, at + 1)};  // in a document, line numbers do not identify records
    }
    Error bad_value(std::int64_t row, std::size_t column, double, const std::string& path) const override {
        return bad_input(fmt::format("record {}: '{}' is not a number; use --bad-fields interpolate to fill it in, or --bad-fields drop to "
                                     "skip the record",
                                     row + 1, info_.columns[column].name),
                         lines_.empty() ? SourceLocation{path} : location(row, path));
    }
    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        for (std::size_t i = 0; i < wanted.size(); ++i)
            std::copy_n(values_[wanted[i]].numbers.begin() + static_cast<std::ptrdiff_t>(first), rows, out[i].begin());
        return {};
    }
};

}  // namespace

Result<std::unique_ptr<Table>> open_json_table(LineReader lines, const std::function<bool()>& should_continue) {
    auto samples = std::make_unique<JsonSamples>(lines.path());
    TRY(samples->open(lines, should_continue));
    return make_table(std::unique_ptr<Samples>(std::move(samples)), lines.path());
}

}  // namespace corpuscle
