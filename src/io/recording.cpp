#include "io/recording.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "io/clock_check.hpp"
#include "io/formats.hpp"
#include "signal/field.hpp"
#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t block_rows = 4096;

std::optional<std::size_t> whole_number(std::string_view text) {
    std::size_t n = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (status != std::errc{} || end != text.data() + text.size()) return {};
    return n;
}

/// The columns of a table that are channels, and how they are asked for.
struct Chooser {
    const Table& table;
    std::optional<std::size_t> time;
    std::string path;
    std::vector<std::size_t> data;  // columns other than the time

    Chooser(const Table& t, std::optional<std::size_t> time_column, std::string p) : table(t), time(time_column), path(std::move(p)) {
        for (std::size_t c = 0; c < table.columns().size(); ++c)
            if (c != time) data.push_back(c);
    }

    Error unknown(std::string_view wanted) const {
        std::vector<std::string_view> names;
        for (const auto c : data) names.push_back(table.columns()[c].name);
        const auto shown = std::span(names).first(std::min<std::size_t>(names.size(), 24));
        return bad_input(fmt::format("no channel '{}'{}; there are {}: {}{}", wanted, did_you_mean(wanted, names), names.size(),
                                     fmt::join(shown, ", "), shown.size() < names.size() ? " ..." : ""),
                         {path});
    }

    Result<void> add(std::string_view wanted, std::vector<std::size_t>& chosen) const {
        for (const auto c : data) {
            const auto& column = table.columns()[c];
            if (column.name == wanted || (!column.unit.empty() && column.name + "_" + column.unit == wanted))
                return chosen.push_back(c), Result<void>{};
        }
        const auto dash = wanted.find('-');
        const auto from = whole_number(wanted.substr(0, dash)),
                   to = dash == std::string_view::npos ? from : whole_number(wanted.substr(dash + 1));
        if (!from || !to || *from < 1 || *to > data.size() || *from > *to) return unknown(wanted);
        for (std::size_t n = *from; n <= *to; ++n) chosen.push_back(data[n - 1]);
        return {};
    }

    Result<std::vector<std::size_t>> choose(const std::vector<std::string>& wanted) const {
        std::vector<std::size_t> chosen;
        if (data.empty()) return bad_input("there is no channel besides the time", {path});
        if (wanted.empty()) return data;
        for (const auto& list : wanted)
            for (std::size_t at = 0; at <= list.size();) {
                const auto end = std::min(list.find(',', at), list.size());
                if (auto ok = add(std::string_view(list).substr(at, end - at), chosen); !ok) return ok.error();
                at = end + 1;
            }
        std::vector<std::size_t> once;
        for (const auto c : chosen)
            if (std::find(once.begin(), once.end(), c) == once.end()) once.push_back(c);
        return once;
    }
};

/// The factor from what stands in the column to newtons.
Result<double> newtons_per_unit(const Column& column, const RecordingOptions& options, const std::string& path) {
    if (options.scale) return *options.scale;
    const std::string& unit = options.unit ? *options.unit : column.unit;
    if (unit.empty()) return 1.0;
    const auto known = unit == "raw" ? Result<Unit>(bad_input("")) : parse_unit(unit);
    if (known && known->newton == 1 && known->second == 0 && known->metre == 0 && known->volt == 0 && known->ampere == 0)
        return known->factor;
    if (options.unit)
        return bad_input(
            fmt::format("'{}' is read as {}, which is no force; say --scale S, so that what is read times S is newtons", column.name, unit),
            {path});
    return bad_input(
        fmt::format(
            "'{}' is in {}, which is no force; say --scale S, so that what is read times S is newtons (or --unit N if the header is wrong)",
            column.name, unit),
        {path});
}

Result<double> seconds_per_unit(const Column& column, const std::string& path) {
    if (column.unit.empty()) return 1.0;
    const auto known = parse_unit(column.unit);
    if (!known || !known->same_kind(*parse_unit("s")))
        return bad_input(
            fmt::format("the time column '{}' is in '{}', which is no time; --time names another, or none", column.name, column.unit),
            {path});
    return known->factor;
}

class Recording final : public Source {
    std::unique_ptr<Table> table_;
    RecordingOptions options_;
    std::string path_, name_;
    Clock clock_;
    std::optional<std::size_t> time_;
    double time_unit_ = 1;
    std::vector<std::size_t> wanted_;  // channels, then the time if rows are placed by it
    std::vector<Channel> channels_;
    std::vector<double> gains_;
    std::vector<std::string> remarks_;
    bool by_times_ = false;                  // resampled between the times of the file
    std::vector<std::vector<double>> rows_;  // as read
    std::size_t row_ = 0, rows_read_ = 0;
    std::int64_t row_number_ = 0;  // of the next row, over the whole file
    // when resampling: the rows before and at the instant looked for
    std::vector<double> before_, at_;
    double t_before_ = 0, t_at_ = 0, row_step_ = 0;
    std::int64_t next_ = 0;

    Error here(std::string sentence) const { return bad_input(std::move(sentence), {path_}); }
    std::string time_name() const { return table_->columns()[*time_].name; }

    Result<void> find_time() {
        time_ = table_->time_column();
        if (options_.time == "none")
            time_.reset();
        else if (options_.time) {
            const auto& columns = table_->columns();
            const auto named = std::find_if(columns.begin(), columns.end(), [&](const Column& c) {
                return c.name == *options_.time || c.name + "_" + c.unit == *options_.time;
            });
            const auto number = whole_number(*options_.time);
            if (named != columns.end())
                time_ = static_cast<std::size_t>(named - columns.begin());
            else if (number && *number >= 1 && *number <= columns.size())
                time_ = *number - 1;
            else
                return here(fmt::format("no column '{}' to take as time; give its name, its number or 'none'", *options_.time));
        }
        if (!time_) return {};
        if (!options_.time && table_->time_is_guessed())
            remarks_.push_back("no header: the first column rises evenly and was taken as the time (--time none takes it as a channel)");
        const auto unit = seconds_per_unit(table_->columns()[*time_], path_);
        if (!unit) return unit.error();
        time_unit_ = *unit;
        return {};
    }

    Result<ClockCheck> check_times() {
        ClockCheck check;
        std::vector<std::vector<double>> block(1);
        for (double last = 0;;) {
            const auto rows = table_->read({*time_}, block_rows, block);
            if (!rows) return rows.error();
            for (std::size_t k = 0; k < *rows; ++k) {
                const double t = block[0][k] * time_unit_;
                if (check.count() > 0 && t < last && !options_.rate) {
                    Place place = table_->place(k);
                    return bad_input(fmt::format("time goes back, from {:g} s to {:g} s; --rate takes the rows as evenly spaced", last, t),
                                     place);
                }
                check.add(last = t);
            }
            if (*rows < block_rows) break;
        }
        if (auto ok = table_->rewind(); !ok) return ok.error();
        return check;
    }

    static std::string hertz(double rate) { return fmt::format("{:.5g} Hz", rate); }

    Error uneven(const ClockCheck& c) const {
        return here(fmt::format(
            "the times in '{}' are not evenly spaced: mean rate {}, steps from {} to {}, samples off their place by up to {}. "
            "Say --rate {:.5g}Hz to take the samples as evenly spaced, or --resample {:.3g}Hz to interpolate between their times",
            time_name(), hertz(1 / c.mean_step()), format_quantity(c.least_step(), "s"), format_quantity(c.longest_step(), "s"),
            format_quantity(c.spread(), "s"), 1 / c.mean_step(), std::max(1.0, std::round(1 / c.mean_step()))));
    }

    /// The clock of the rows, from --rate or from their times.
    Result<Clock> clock_of_rows() {
        if (!time_) {
            if (!options_.rate) return here("there is no time column; say --rate, such as --rate 1kHz");
            return clock_of(*options_.rate);
        }
        const auto times = check_times();
        if (!times) return times.error();
        if (times->count() < 1) return here("no data in this file");
        if (options_.rate) {
            if (times->count() > 1 && std::abs(times->mean_step() * *options_.rate - 1) > 0.01)
                remarks_.push_back(fmt::format("--rate says {}, the times in '{}' say {} on the mean", hertz(*options_.rate), time_name(),
                                               hertz(1 / times->mean_step())));
            else if (times->count() > 1 && !times->even())
                remarks_.push_back(fmt::format("the uneven times in '{}' (steps from {} to {}) were replaced by an even clock of {}",
                                               time_name(), format_quantity(times->least_step(), "s"),
                                               format_quantity(times->longest_step(), "s"), hertz(*options_.rate)));
            return clock_of(*options_.rate, times->first());
        }
        if (times->count() == 1) return here(fmt::format("one sample has no rate of its own; say --rate, such as --rate 1kHz"));
        if (!(times->mean_step() > 0))
            return here(fmt::format("the times in '{}' do not advance; say --rate, such as --rate 1kHz", time_name()));
        if (times->even()) return times->clock();
        if (!options_.resample) return uneven(*times);
        by_times_ = true;
        remarks_.push_back(fmt::format("the uneven times in '{}' (steps from {} to {}) were interpolated at {}", time_name(),
                                       format_quantity(times->least_step(), "s"), format_quantity(times->longest_step(), "s"),
                                       hertz(*options_.resample)));
        return clock_of(*options_.resample, times->first());
    }

    Result<void> set_clock() {
        const auto rows = clock_of_rows();
        if (!rows) return rows.error();
        clock_ = *rows;
        row_step_ = rows->T();
        if (!options_.resample) return {};
        const auto even = clock_of(*options_.resample, rows->t0);
        if (!even) return even.error();
        clock_ = *even;
        return {};
    }

    Result<void> choose_channels() {
        const auto chosen = Chooser(*table_, time_, path_).choose(options_.channels);
        if (!chosen) return chosen.error();
        bool told = false;
        for (const auto c : *chosen) {
            const auto& column = table_->columns()[c];
            const auto gain = newtons_per_unit(column, options_, path_);
            if (!gain) return gain.error();
            if (column.unit.empty() && !options_.unit && !options_.scale && !std::exchange(told, true))
                remarks_.push_back("no unit in the file: taken as newtons");
            gains_.push_back(*gain);
            channels_.push_back({static_cast<std::uint32_t>(channels_.size()), column.name});
        }
        wanted_ = *chosen;
        if (by_times_) wanted_.push_back(*time_);
        rows_.resize(wanted_.size());
        return {};
    }

    /// Makes sure that rows_[..][row_] is the next row; false at the end.
    Result<bool> another_row() {
        if (row_ < rows_read_) return true;
        const auto rows = table_->read(wanted_, block_rows, rows_);
        if (!rows) return rows.error();
        row_ = 0, rows_read_ = *rows;
        return rows_read_ > 0;
    }

    double force(std::size_t channel) const {
        const double x = rows_[channel][row_];
        return gains_[channel] * (options_.absolute ? std::abs(x) : x);
    }

    Result<bool> advance_to_next_row() {
        const auto more = another_row();
        if (!more || !*more) return more;
        before_ = at_, t_before_ = t_at_;
        at_.resize(channels_.size());
        for (std::size_t c = 0; c < channels_.size(); ++c) at_[c] = force(c);
        t_at_ = by_times_ ? rows_.back()[row_] * time_unit_ : clock_.t0 + static_cast<double>(row_number_) * row_step_;
        if (by_times_ && row_number_ > 0 && t_at_ <= t_before_) {
            Place place = table_->place(row_);
            return bad_input(fmt::format("the time {:g} s stands twice; --rate takes the rows as evenly spaced", t_at_), place);
        }
        ++row_, ++row_number_;
        return true;
    }

    Result<void> read_resampled(Frames& block) {
        if (row_number_ == 0)
            if (const auto first = advance_to_next_row(); !first) return first.error();
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
        if (auto ok = find_time(); !ok) return ok;
        if (auto ok = set_clock(); !ok) return ok;
        return choose_channels();
    }

    const std::string& name() const override { return name_; }
    const Clock& clock() const override { return clock_; }
    const std::vector<Channel>& channels() const override { return channels_; }
    double done() const override { return table_->done(); }
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
    auto extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (!extension.empty())
        for (const auto& f : formats)
            if ((" " + std::string(f.extensions) + " ").find(" " + extension + " ") != std::string::npos) return f;
    return formats[0];
}

}  // namespace

Result<std::unique_ptr<Source>> open_recording(const std::string& path, const RecordingOptions& options) {
    if (options.unit && options.scale && *options.unit != "raw") return bad_usage("--unit and --scale both say what is read: give one");
    auto table = format_of(path).open(path);
    if (!table) return table.error();
    auto recording = std::make_unique<Recording>(path, std::move(*table), options);
    if (auto ok = recording->open(); !ok) return ok.error();
    return std::unique_ptr<Source>(std::move(recording));
}

}  // namespace corpuscle
