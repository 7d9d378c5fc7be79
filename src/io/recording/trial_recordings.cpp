#include "io/recording/trial_recordings.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_trials = 20'000;
constexpr std::size_t max_numbers = std::size_t{1} << 27;  // in memory; they need one gigabyte

/// The table of all trials. Its columns are read when they are first needed, all rows at once.
class LongTable {
    std::unique_ptr<Table> table_;
    std::map<std::size_t, std::vector<double>> columns_ = {};  // those that were read
    std::vector<SourceLocation> locations_ = {};               // of all rows

public:
    explicit LongTable(std::unique_ptr<Table> table) : table_(std::move(table)) {}
    Table& table() { return *table_; }
    const std::vector<double>& column(std::size_t c) const { return columns_.at(c); }
    const SourceLocation& location(std::size_t row) const { return locations_[row]; }

    /// Reads those of the columns that were not read.
    Result<void> load(const std::vector<std::size_t>& wanted) {
        std::vector<std::size_t> missing;
        for (const auto c : wanted)
            if (!columns_.contains(c) && std::find(missing.begin(), missing.end(), c) == missing.end()) missing.push_back(c);
        if (missing.empty()) return {};
        table_->allow_gaps(true);  // gaps are treated when a trial is read
        TRY(table_->rewind());
        const bool keeps_locations = locations_.empty();
        for (std::vector<std::vector<double>> block(missing.size());;) {
            const auto rows = TRY(table_->read(missing, rows_per_block, block));
            if (rows == 0) return {};
            for (std::size_t k = 0; k < rows && keeps_locations; ++k) locations_.push_back(table_->location(k));
            for (std::size_t i = 0; i < missing.size(); ++i) {
                auto& to = columns_[missing[i]];
                to.insert(to.end(), block[i].begin(), block[i].begin() + static_cast<std::ptrdiff_t>(rows));
                if (to.size() * columns_.size() > max_numbers)
                    return bad_input(fmt::format("the trials have more than {} numbers, which are too many for memory; select channels with "
                                                 "--channel, or use a file for each trial",
                                                 max_numbers),
                                     location(0));
            }
        }
    }

    /// The error of the table for the first field of a column that is not a number.
    Error bad_field(std::size_t column) {
        table_->allow_gaps(false);
        if (const auto ok = table_->rewind(); !ok) return ok.error();
        for (std::vector<std::vector<double>> block(1);;) {
            const auto rows = table_->read({column}, rows_per_block, block);
            if (!rows) return rows.error();
            if (*rows == 0) return bad_input(fmt::format("'{}' holds a value that is not a number", table_->columns()[column].name));
        }
    }
};

/// The rows of one trial.
class TrialTable final : public Table {
    std::shared_ptr<LongTable> all_;
    std::vector<std::size_t> rows_;  // indexes in the table of all trials
    std::size_t block_ = 0, next_ = 0;

public:
    TrialTable(std::shared_ptr<LongTable> all, std::vector<std::size_t> rows) : all_(std::move(all)), rows_(std::move(rows)) {
        info_ = all_->table().info();
        info_.is_orientation_known = true;
    }
    Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t max_rows, std::vector<std::vector<double>>& out) override {
        TRY(all_->load(wanted));
        block_ = next_;
        const auto count = std::min(max_rows, rows_.size() - next_);
        next_ += count;
        for (auto& column : out) column.resize(count);
        for (std::size_t i = 0; i < wanted.size(); ++i)
            for (std::size_t k = 0; k < count; ++k) {
                out[i][k] = all_->column(wanted[i])[rows_[block_ + k]];
                if (!allows_gaps_ && std::isnan(out[i][k])) return all_->bad_field(wanted[i]);
            }
        return count;
    }
    Result<void> rewind() override { return next_ = 0, Result<void>{}; }
    double progress() const override { return static_cast<double>(next_) / static_cast<double>(rows_.size()); }
    SourceLocation location(std::size_t row) const override { return all_->location(rows_[block_ + row]); }
};

/// The index of a column by its name.
Result<std::size_t> column_named(const Table& table, const std::string& name, std::string_view option, const std::string& path) {
    std::vector<std::string_view> names;
    for (const auto& c : table.columns()) names.push_back(c.name);
    for (std::size_t c = 0; c < names.size(); ++c)
        if (equal_ignoring_case(names[c], name)) return c;
    return bad_input(fmt::format("{} {}: there is no such column{} (columns: {})", option, name, did_you_mean(name, names),
                                 joined(std::span(names).first(std::min<std::size_t>(names.size(), 12)))),
                     {path});
}

struct TrialRows {
    std::string name;  // "trial 3"
    std::vector<std::size_t> rows;
};

/// The rows of each trial, in the order of their first rows.
Result<std::vector<TrialRows>> rows_of_trials(Table& table, const std::vector<std::string>& by, const std::string& path) {
    std::vector<std::vector<std::string>> texts;
    for (const auto& name : by) {
        const auto column = TRY(column_named(table, name, "--by", path));
        texts.push_back(TRY(table.texts(column)));
    }
    std::vector<TrialRows> out;
    std::map<std::string, std::size_t> index_of;
    for (std::size_t row = 0; row < texts[0].size(); ++row) {
        std::string name;
        for (std::size_t k = 0; k < by.size(); ++k) name += fmt::format("{}{} {}", k > 0 ? " " : "", by[k], texts[k][row]);
        const auto [at, is_new] = index_of.try_emplace(name, out.size());
        if (is_new) out.push_back({name, {}});
        out[at->second].rows.push_back(row);
        if (out.size() > max_trials)
            return bad_input(fmt::format("--by {}: more than {} different values; name the column that identifies the trials",
                                         joined(by, ","), max_trials),
                             {path});
    }
    if (out.empty()) return bad_input("there are no rows in this table", {path});
    return out;
}

/// The label of a trial: the text of its rows, which must be equal.
Result<std::string> label_of(const TrialRows& trial, const std::vector<std::string>& labels, const std::string& column,
                             const std::string& path) {
    for (const auto row : trial.rows)
        if (labels[row] != labels[trial.rows[0]])
            return bad_input(fmt::format("--label {}: {} has two labels, '{}' and '{}'; add the column to --by", column, trial.name,
                                         labels[trial.rows[0]], labels[row]),
                             {path});
    return labels[trial.rows[0]];
}

}  // namespace

Result<std::vector<TrialRecording>> open_trial_recordings(const std::string& path, const RecordingOptions& options,
                                                          const TrialColumns& columns) {
    auto table = TRY(open_recording_table(path, options));
    const auto trials = TRY(rows_of_trials(*table, columns.by, path));
    std::vector<std::string> labels;
    if (columns.label) {
        const auto column = TRY(column_named(*table, *columns.label, "--label", path));
        labels = TRY(table->texts(column));
    }
    const auto all = std::make_shared<LongTable>(std::move(table));
    const auto file = std::filesystem::path(path).stem().string();
    std::vector<TrialRecording> out;
    for (const auto& trial : trials) {
        auto label = labels.empty() ? file : TRY(label_of(trial, labels, *columns.label, path));
        auto source = make_recording(std::make_unique<TrialTable>(all, trial.rows), path, file + " " + trial.name, options);
        if (!source) {
            auto error = source.error();
            error.message = trial.name + ": " + error.message;
            return error;
        }
        out.push_back({std::move(label), std::move(*source)});
    }
    return out;
}

}  // namespace corpuscle
