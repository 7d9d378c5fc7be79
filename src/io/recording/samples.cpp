#include "io/recording/samples.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numeric>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::uint64_t max_columns = std::uint64_t{1} << 20;
constexpr std::size_t max_inspected_numbers = std::size_t{1} << 22;  // in the rows that are read to find the roles of the columns

/// Samples as a table.
class SamplesTable final : public Table {
    std::string path_;
    std::unique_ptr<Samples> samples_;
    std::int64_t block_ = 0, next_ = 0;  // indices of the first row of the last block, and of the next row to read

    std::int64_t rows() const { return samples_->info().rows; }

    /// Checks the values of a column in the rows from next_ on. Replaces infinities by gaps (NaN). If gaps are not allowed, returns an
    /// error for the first value that is not finite.
    Result<void> check_values(std::vector<double>& values, std::size_t column) const {
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (std::isfinite(values[k])) continue;
            if (!allows_gaps_) return samples_->bad_value(next_ + static_cast<std::int64_t>(k), column, values[k], path_);
            values[k] = std::numeric_limits<double>::quiet_NaN();
        }
        return {};
    }

    /// The time column and the columns that are not channels by their names and first rows, as for a text file.
    Result<ColumnRoles> find_roles() {
        if (!has_named_columns(info_.columns)) return ColumnRoles{.time_column = info_.time_column};
        const auto count = std::min({inspected_rows, static_cast<std::size_t>(rows()), max_inspected_numbers / info_.columns.size()});
        std::vector<std::size_t> all(info_.columns.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::vector<std::vector<double>> numbers(info_.columns.size(), std::vector<double>(count));
        TRY(samples_->fetch(0, count, all, numbers));
        std::vector<FirstFields> first(info_.columns.size());
        for (std::size_t c = 0; c < first.size(); ++c)
            for (const double x : numbers[c]) first[c].add_number(x);
        return assign_roles(info_.columns, first, true, info_.time_column);
    }

public:
    SamplesTable(std::string path, std::unique_ptr<Samples> samples) : path_(std::move(path)), samples_(std::move(samples)) {}

    Result<void> open() {
        info_ = samples_->info();
        if (!(info_.rate > 0.0)) info_.rate.reset();
        if (samples_->info().has_roles) return {};
        auto roles = TRY(find_roles());
        info_.time_column = roles.time_column, info_.is_time_guessed = roles.is_time_guessed, info_.time_notes = std::move(roles.notes);
        return {};
    }
    double progress() const override { return static_cast<double>(next_) / static_cast<double>(rows()); }
    SourceLocation location(std::size_t row) const override { return samples_->location(block_ + static_cast<std::int64_t>(row), path_); }
    Result<void> rewind() override { return next_ = 0, Result<void>{}; }
    Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t max_rows, std::vector<std::vector<double>>& out) override {
        const auto count = static_cast<std::size_t>(std::min(static_cast<std::int64_t>(max_rows), rows() - next_));
        for (auto& column : out) column.resize(count);
        if (count == 0 || wanted.empty()) return count;
        TRY(samples_->fetch(next_, count, wanted, out));
        for (std::size_t i = 0; i < wanted.size(); ++i) TRY(check_values(out[i], wanted[i]));
        block_ = next_;
        next_ += static_cast<std::int64_t>(count);
        return count;
    }
};

/// Samples with the times as their first column.
class WithTimes final : public Samples {
    std::unique_ptr<Samples> times_, samples_;

public:
    WithTimes(std::unique_ptr<Samples> times, std::unique_ptr<Samples> samples) : times_(std::move(times)), samples_(std::move(samples)) {
        info_ = samples_->info();
        info_.columns.insert(info_.columns.begin(), times_->info().columns[0]);
        info_.time_column = 0;
        info_.notes.insert(info_.notes.end(), times_->info().notes.begin(), times_->info().notes.end());
    }
    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        std::vector<std::size_t> others;          // the wanted columns other than the time, as columns of samples_
        std::vector<std::vector<double>> values;  // of these columns
        const auto exchange = [&] {               // moves the columns of the samples between `out` and `values`
            for (std::size_t i = 0, k = 0; i < wanted.size(); ++i)
                if (wanted[i] != 0) std::swap(values[k++], out[i]);
        };
        for (const auto c : wanted)
            if (c != 0) others.push_back(c - 1);
        values.resize(others.size());
        exchange();
        auto ok = others.empty() ? Result<void>() : samples_->fetch(first, rows, others, values);
        exchange();
        std::vector<std::vector<double>> time(1, std::vector<double>(others.size() < wanted.size() ? rows : 0));
        if (ok && !time[0].empty()) ok = times_->fetch(first, rows, std::vector<std::size_t>{0}, time);
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (wanted[i] == 0) out[i] = time[0];
        return ok;
    }
};

/// The first arrays with their shapes, for messages.
std::string list_arrays(std::span<const ArrayInfo> arrays) {
    constexpr std::size_t limit = 24;
    std::vector<std::string> texts;
    for (const auto& a : arrays.first(std::min(arrays.size(), limit))) texts.push_back(describe(a));
    return fmt::format("{}{}", joined(texts), arrays.size() > limit ? " ..." : "");
}

/// True if the array can be a recording, by its type and number of dimensions.
bool is_usable(const ArrayInfo& a) { return a.is_numeric && (a.shape.size() == 1 || a.shape.size() == 2); }

bool is_single_value(const ArrayInfo& a) {
    return std::all_of(a.shape.begin(), a.shape.end(), [](auto n) { return n == 1; });
}

/// True for a list of times, a rate or another scalar, which belong to another array.
bool is_accessory(const ArrayInfo& a) {
    const auto name = last_path_component(a.name);
    return is_time_name(parse_heading(name).name) || (is_single_value(a) && (is_rate_name(name) || a.shape.empty()));
}

/// Decides which dimension of an array of two dimensions is the samples, and sets `e`, in which the first dimension is the rows,
/// accordingly.
Result<void> orient(ArrayExtent& e, const ArrayInfo& a, const std::string& path, const ExtentHints& hints) {
    const auto flip = [&e] { std::swap(e.rows, e.columns), e.is_transposed = !e.is_transposed; };
    if (e.rows == 1 && e.columns > 1 && hints.transpose != false) return flip(), Result<void>{};
    if (hints.is_column_major && e.columns > 1) flip();
    if (hints.transpose) return *hints.transpose ? flip() : void(), Result<void>{};
    if (e.columns <= e.rows || e.rows == 1) return {};
    // True if n is the length of a list of times.
    const auto is_length = [&](std::uint64_t n) {
        return std::find(hints.time_lengths.begin(), hints.time_lengths.end(), n) != hints.time_lengths.end();
    };
    if (is_length(e.rows) || (hints.channel_names == e.columns && !is_length(e.columns))) return {};
    if (is_length(e.columns) || hints.channel_names == e.rows) {
        flip();
        e.note = fmt::format("{}: taken as {} channels of {} samples, to match {}; use --no-transpose if each row is a sample", describe(a),
                             e.columns, e.rows, is_length(e.rows) ? "the times" : "the channel names");
        return {};
    }
    return bad_input(
        fmt::format("{}: {} channels of only {} samples? Use --transpose if each row is a channel, or --no-transpose if each row is a "
                    "sample",
                    describe(a), e.columns, e.rows),
        {path});
}

/// True if the last components of `path` are `names`.
bool ends_in(std::string_view path, std::string_view names) {
    return path == names || (path.ends_with(names) && path.size() > names.size() && path[path.size() - names.size() - 1] == '/');
}

/// The indices of the arrays that match `wanted`: those whose complete path it is (with or without the first slash); if there is none,
/// those whose path ends with it. The path of a group stands for its member `data`.
std::vector<std::size_t> matching_arrays(std::string_view wanted, std::span<const ArrayInfo> arrays) {
    if (wanted.starts_with('/')) wanted.remove_prefix(1);
    const auto find_all = [&](const auto& fits) {
        std::vector<std::size_t> found;
        for (std::size_t k = 0; k < arrays.size(); ++k) {
            std::string_view name = arrays[k].name;
            if (name.starts_with('/')) name.remove_prefix(1);
            if (fits(name)) found.push_back(k);
        }
        return found;
    };
    const auto data = std::string(wanted) + "/data";
    if (auto exact = find_all([&](auto name) { return name == wanted; }); !exact.empty()) return exact;
    if (auto group = find_all([&](auto name) { return name == data; }); !group.empty()) return group;
    return find_all([&](auto name) { return ends_in(name, wanted) || ends_in(name, data); });
}

/// The index of the only array that matches `wanted`.
Result<std::size_t> array_by_name(const std::string& wanted, std::span<const ArrayInfo> arrays, const std::string& path) {
    std::vector<std::string_view> names;
    for (const auto& a : arrays) names.push_back(a.name);
    const auto matches = matching_arrays(wanted, arrays);
    if (matches.size() > 1) {
        std::vector<ArrayInfo> ambiguous;
        for (const auto k : matches) ambiguous.push_back(arrays[k]);
        return bad_input(fmt::format("several arrays match '{}'; select one with --dataset PATH: {}", wanted, list_arrays(ambiguous)),
                         {path});
    }
    if (matches.empty())
        return bad_input(fmt::format("no array '{}'{}; arrays: {}", wanted, did_you_mean(wanted, names), list_arrays(arrays)), {path});
    const auto k = matches[0];
    if (is_usable(arrays[k])) return k;
    return bad_input(fmt::format("{}: a recording must be numeric with one dimension, or two (rows and channels)", describe(arrays[k])),
                     {path});
}

/// The index of the only array that can be a recording.
Result<std::size_t> only_array(std::span<const ArrayInfo> arrays, const std::string& path) {
    std::vector<std::size_t> usable, likely;  // likely: usable, and neither times nor a rate
    std::vector<ArrayInfo> candidates;        // the arrays of `likely`
    for (std::size_t k = 0; k < arrays.size(); ++k) {
        if (!is_usable(arrays[k])) continue;
        usable.push_back(k);
        if (!is_accessory(arrays[k])) likely.push_back(k), candidates.push_back(arrays[k]);
    }
    if (likely.size() == 1) return likely[0];
    if (likely.empty() && usable.size() == 1) return usable[0];
    if (!likely.empty())
        return bad_input(fmt::format("several arrays could be the recording; select one with --dataset NAME: {}", list_arrays(candidates)),
                         {path});
    return bad_input(
        fmt::format("no array can be the recording, which must be numeric with one or two dimensions; arrays: {}", list_arrays(arrays)),
        {path});
}

}  // namespace

Result<std::unique_ptr<Table>> make_table(SamplesResult samples, const std::string& path) {
    if (!samples) return samples.error();
    if ((*samples)->info().rows < 1 || (*samples)->info().columns.empty()) return bad_input("no data in this file", {path});
    auto table = std::make_unique<SamplesTable>(path, *std::move(samples));
    TRY(table->open());
    return std::unique_ptr<Table>(std::move(table));
}

Error Samples::bad_value(std::int64_t row, std::size_t column, double value, const std::string& path) const {
    return bad_input(fmt::format("row {}: column '{}': {} where a number is expected", row + 1, info_.columns[column].name, value), {path});
}

std::unique_ptr<Samples> add_time_column(std::unique_ptr<Samples> times, std::unique_ptr<Samples> samples) {
    return std::make_unique<WithTimes>(std::move(times), std::move(samples));
}

std::string describe(const ArrayInfo& a) {
    const auto shape = a.shape.empty() ? "scalar" : fmt::format("{}", fmt::join(a.shape, " x "));
    return fmt::format("{} ({}{})", a.name.empty() ? "the array" : a.name, shape, a.is_numeric ? "" : ", not numeric");
}

Result<std::size_t> choose_array(std::span<const ArrayInfo> arrays, const std::optional<std::string>& wanted, const std::string& path) {
    if (arrays.empty()) return bad_input("there is no array in this file", {path});
    return wanted ? array_by_name(*wanted, arrays, path) : only_array(arrays, path);
}

bool is_rate_name(std::string_view name) {
    constexpr std::string_view words[] = {"rate", "fs", "sampling_rate", "sample_rate", "sampling_frequency", "samplerate"};
    return std::find(std::begin(words), std::end(words), lower(name)) != std::end(words);
}

std::string_view last_path_component(std::string_view path) { return path.substr(path.rfind('/') + 1); }

Result<ArrayExtent> extent_of(const ArrayInfo& a, const std::string& path, const ExtentHints& hints) {
    if (a.shape.empty() || a.shape.size() > 2)
        return bad_input(fmt::format("{}: a recording must have one dimension, or two (rows and channels)", describe(a)), {path});
    ArrayExtent e{a.shape[0], a.shape.size() == 2 ? a.shape[1] : 1};
    if (e.rows == 0 || e.columns == 0) return bad_input(fmt::format("{}: it has no samples", describe(a)), {path});
    TRY(a.shape.size() == 2 ? orient(e, a, path, hints) : Result<void>());
    if (e.columns > max_columns) return bad_input(fmt::format("{}: more than {} channels", describe(a), max_columns), {path});
    return e;
}

std::optional<std::uint64_t> time_list_length(const ArrayInfo& a) {
    if (!a.is_numeric || a.shape.empty() || a.shape.size() > 2 || !is_time_name(parse_heading(last_path_component(a.name)).name)) return {};
    if (a.shape.size() == 2 && a.shape[0] != 1 && a.shape[1] != 1) return {};
    return a.shape.size() == 2 ? a.shape[0] * a.shape[1] : a.shape[0];
}

std::vector<Column> columns_named_after(std::string_view array, std::size_t count) {
    const auto heading = parse_heading(array);
    if (count == 1 && !heading.name.empty()) return {heading};
    std::vector<Column> columns;
    for (std::size_t c = 0; c < count; ++c) columns.push_back({fmt::format("ch{}", c + 1), heading.unit});
    return columns;
}

}  // namespace corpuscle
