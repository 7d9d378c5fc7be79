#include "io/recording.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "io/columns.hpp"
#include "io/formats.hpp"
#include "io/row_clock.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

class Recording final : public Source {
    std::unique_ptr<Table> table_;
    RecordingOptions options_;
    std::string path_, name_;
    RowClock rows_clock_;
    Clock clock_;
    std::vector<std::size_t> wanted_;  // channels, then the time if rows are placed by it
    std::vector<Channel> channels_;
    std::vector<double> gains_;
    std::vector<std::string> remarks_;
    std::vector<std::vector<double>> rows_;  // as read
    std::size_t row_ = 0, rows_read_ = 0;
    std::int64_t row_number_ = 0;  // of the next row, over the whole file
    // when resampling: the rows before and at the instant looked for
    std::vector<double> before_, at_;
    double t_before_ = 0, t_at_ = 0;
    std::int64_t next_ = 0;

    Result<void> set_clock() {
        auto rows = find_row_clock(*table_, options_, path_);
        if (!rows) return rows.error();
        rows_clock_ = std::move(*rows);
        clock_ = rows_clock_.clock;
        remarks_ = rows_clock_.remarks;
        if (!options_.resample) return {};
        const auto even = clock_of(*options_.resample, clock_.t0);
        if (!even) return even.error();
        clock_ = *even;
        return {};
    }

    Result<void> choose_channels() {
        const auto chosen = choose_columns(*table_, rows_clock_.column, options_.channels, path_);
        if (!chosen) return chosen.error();
        std::vector<std::string> unitless;
        for (const auto c : *chosen) {
            const auto& column = table_->columns()[c];
            const auto gain = newtons_per_unit(column, options_, path_);
            if (!gain) return gain.error();
            if (column.unit.empty() && !options_.unit && !options_.scale) unitless.push_back("'" + column.name + "'");
            if (!column.unit.empty() && options_.unit && *options_.unit != column.unit && !options_.scale)
                remarks_.push_back(
                    fmt::format("the header says '{}' is in {}; read as {}, as --unit says", column.name, column.unit, *options_.unit));
            gains_.push_back(*gain);
            const auto same = std::count_if(chosen->begin(), std::find(chosen->begin(), chosen->end(), c),
                                            [&](auto other) { return table_->columns()[other].name == column.name; });
            channels_.push_back(
                {static_cast<std::uint32_t>(channels_.size()), same == 0 ? column.name : fmt::format("{} ({})", column.name, same + 1)});
        }
        if (unitless.size() > 6) unitless.resize(6), unitless.push_back("...");
        if (!unitless.empty()) remarks_.push_back(fmt::format("no unit for {}: taken as newtons", fmt::join(unitless, ", ")));
        wanted_ = *chosen;
        if (rows_clock_.by_times) wanted_.push_back(*rows_clock_.column);
        rows_.resize(wanted_.size());
        return {};
    }

    /// Makes sure that rows_[..][row_] is the next row; false at the end.
    Result<bool> another_row() {
        if (row_ < rows_read_) return true;
        const auto rows = table_->read(wanted_, rows_a_block, rows_);
        if (!rows) return rows.error();
        row_ = 0, rows_read_ = *rows;
        return rows_read_ > 0;
    }

    double force(std::size_t channel) const {
        const double x = rows_[channel][row_];  // a product that overflows is refused by whoever takes the force
        return gains_[channel] * (options_.absolute ? std::abs(x) : x);
    }

    Result<bool> advance_to_next_row() {
        const auto more = another_row();
        if (!more || !*more) return more;
        before_ = at_, t_before_ = t_at_;
        at_.resize(channels_.size());
        for (std::size_t c = 0; c < channels_.size(); ++c) at_[c] = force(c);
        t_at_ = rows_clock_.by_times ? rows_.back()[row_] * rows_clock_.seconds_per_unit
                                     : clock_.t0 + static_cast<double>(row_number_) * rows_clock_.clock.T();
        if (rows_clock_.by_times && row_number_ > 0 && t_at_ <= t_before_) {
            return bad_input(fmt::format("the time {:g} s stands twice; --rate takes the rows as evenly spaced", t_at_),
                             table_->place(row_));
        }
        ++row_, ++row_number_;
        return true;
    }

    Result<void> read_resampled(Frames& block) {
        if (row_number_ == 0)
            if (const auto first = advance_to_next_row(); !first || !*first) return first ? Result<void>() : first.error();
        for (; block.count < block.capacity; ++block.count, ++next_) {
            const double t = clock_.time(next_);
            while (t_at_ < t - 1e-9 * clock_.T()) {
                const auto more = advance_to_next_row();
                if (!more) return more.error();
                if (!*more) return {};
            }
            const double x = row_number_ == 1 ? 1 : std::clamp((t - t_before_) / (t_at_ - t_before_), 0.0, 1.0);
            for (std::size_t c = 0; c < channels_.size(); ++c)
                block.force[c][block.count] = row_number_ == 1 ? at_[c] : before_[c] + (at_[c] - before_[c]) * x;
        }
        return {};
    }

public:
    Recording(std::string path, std::unique_ptr<Table> table, RecordingOptions options)
        : table_(std::move(table)), options_(std::move(options)), path_(std::move(path)),
          name_(std::filesystem::path(path_).stem().string()) {}

    Result<void> open() {
        if (auto ok = set_clock(); !ok) return ok;
        return choose_channels();
    }

    const std::string& name() const override { return name_; }
    const Clock& clock() const override { return clock_; }
    const std::vector<Channel>& channels() const override { return channels_; }
    double done() const override { return table_->done(); }
    std::vector<Fact> facts() const override {
        std::vector<Fact> all;
        for (std::size_t c = 0; c < channels_.size(); ++c) all.push_back({channels_[c].name + ": newtons per unit", gains_[c], "N"});
        all.push_back({"absolute value", options_.absolute ? 1.0 : 0.0, ""});
        if (options_.resample) all.push_back({"resampled from", rows_clock_.by_times ? 0 : rows_clock_.clock.rate(), "Hz"});
        return all;
    }
    std::string sentence() const override {
        return fmt::format("{} of {}, at {:g} Hz", channels_.size() == 1 ? "a channel" : fmt::format("{} channels", channels_.size()),
                           std::filesystem::path(path_).filename().string(), clock_.rate());
    }
    std::vector<std::string> remarks() const override { return remarks_; }

    Result<void> read(Frames& block) override {
        block.count = 0;
        if (options_.resample) return read_resampled(block);
        while (block.count < block.capacity) {
            const auto more = another_row();
            if (!more) return more.error();
            if (!*more) return {};
            for (std::size_t c = 0; c < channels_.size(); ++c) block.force[c][block.count] = force(c);
            ++block.count, ++row_;
        }
        return {};
    }
};

const Format& format_of(const std::string& path) {
    const auto extension = lower(std::filesystem::path(path).extension().string());
    if (!extension.empty())
        for (const auto& f : formats)
            if ((" " + std::string(f.extensions) + " ").find(" " + extension + " ") != std::string::npos) return f;
    return formats[0];
}

}  // namespace

Result<std::unique_ptr<Source>> open_recording(const std::string& path, const RecordingOptions& options) {
    if (options.unit && options.scale && *options.unit != "raw") return bad_usage("--unit and --scale both say what is read: give one");
    auto table = format_of(path).open(path, options.table);
    if (!table) return table.error();
    auto recording = std::make_unique<Recording>(path, std::move(*table), options);
    if (auto ok = recording->open(); !ok) return ok.error();
    return std::unique_ptr<Source>(std::move(recording));
}

}  // namespace corpuscle
