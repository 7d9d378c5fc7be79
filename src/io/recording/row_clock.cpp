#include "io/recording/row_clock.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/recording/column_selection.hpp"
#include "io/recording/force_rows.hpp"
#include "io/text/time_stamp.hpp"

namespace corpuscle {
namespace {

/// Removes every second point of one side of the hull, except the first and the last point. There are more than max_points points, so the
/// largest distance of a point from a straight line changes very little.
template <class Points>
void thin(Points& side) {
    std::size_t kept = 1;
    for (std::size_t k = 2; k + 1 < side.size(); k += 2) side[kept++] = side[k];
    side[kept++] = side.back();
    side.resize(kept);
}

/// A rate as text.
std::string hertz(double rate) { return fmt::format("{:.5g} Hz", rate); }

/// The smallest and the largest time step as text.
std::string step_range(const ClockAnalysis& c) {
    return fmt::format("steps from {} to {}", format_quantity(c.min_step(), "s"), format_quantity(c.max_step(), "s"));
}

struct TimeCheck : ClockAnalysis {
    std::optional<Error> duplicate;  ///< the error for the first time that occurs in two consecutive rows; nullopt: none does
};

/// Reads all times, the last column of `rows`, and rewinds the table. A time that decreases is an error unless --rate replaces the times.
Result<TimeCheck> check_times(Table& table, RowReader rows, const RowClock& clock, const RecordingOptions& options) {
    TimeCheck check;
    std::vector<std::vector<double>> block;
    for (double last = 0;;) {
        const auto count = TRY(rows.next(block));
        if (count == 0) break;
        for (std::size_t k = 0; k < count; ++k) {
            const double t = clock.seconds(block.back()[k]);
            if (std::isnan(t)) {
                check.skip();
                continue;
            }
            if (check.count() > 0 && t < last && !options.rate) {
                const auto trials = table.single_trial_advice(rows.table_row(k));
                return bad_input(fmt::format("the time decreases from {:g} s to {:g} s{}", last, t,
                                             trials.empty() ? "; use --rate to take the rows as evenly spaced" : ": " + trials),
                                 rows.location(k));
            }
            if (check.count() > 0 && t == last && !check.duplicate)
                check.duplicate = bad_input(fmt::format("the time {:g} s occurs twice; use --rate to take the rows as evenly spaced", t),
                                            rows.location(k));
            check.add(last = t);
        }
        if (!options.should_continue(table.progress())) return interrupted_error();
    }
    TRY(table.rewind());
    return check;
}

/// The error message for uneven times. `name` is the name of the time column.
std::string uneven_message(const std::string& name, const ClockAnalysis& c) {
    const double mean = 1 / c.mean_step();
    return fmt::format(
        "the times in '{}' are not evenly spaced: mean rate {}, {}, jitter up to {}. Use --rate {:.5g}Hz to take the samples as evenly "
        "spaced{}",
        name, hertz(mean), step_range(c), format_quantity(c.peak_to_peak_jitter(), "s"), mean,
        c.min_step() > 0 ? fmt::format(", or --resample {:g}Hz to interpolate between their times", std::max(1.0, std::round(mean))) : "");
}

/// The clock of the given rate, in Hz, that begins at the first time. Adds a note if the times contradict the rate. `name` is the name of
/// the time column.
Result<Clock> clock_by_rate(double rate, const std::string& name, const ClockAnalysis& times, std::vector<std::string>& notes) {
    if (times.count() > 1 && times.min_step() < 0)
        notes.push_back(
            fmt::format("the times in '{}' decrease (by up to {}), as in a file with several trials; with --rate all rows are one "
                        "recording",
                        name, format_quantity(-times.min_step(), "s")));
    else if (times.count() > 1 && std::abs(times.mean_step() * rate - 1) > 0.01)
        notes.push_back(
            fmt::format("--rate is {}, but the mean rate of the times in '{}' is {}", hertz(rate), name, hertz(1 / times.mean_step())));
    else if (times.count() > 1 && !times.is_even())
        notes.push_back(
            fmt::format("the uneven times in '{}' ({}) were replaced by an even clock of {}", name, step_range(times), hertz(rate)));
    return make_clock(rate, times.first());
}

/// The clock that follows from the times. Sets out.uses_row_times if the times are uneven, so that the rows must be interpolated. `name` is
/// the name of the time column.
Result<Clock> clock_by_times(const std::string& name, const TimeCheck& times, const RecordingOptions& options, RowClock& out) {
    if (times.count() == 1) return bad_input("a single sample has no rate; give one, such as --rate 1kHz");
    if (!(times.mean_step() > 0))
        return bad_input(fmt::format("the times in '{}' do not increase; give a rate, such as --rate 1kHz", name));
    if (times.is_even()) return times.clock();
    if (!options.resample) return bad_input(uneven_message(name, times));
    if (times.duplicate) return *times.duplicate;
    if (options.interpolation == Interpolation::smooth)
        return bad_input(
            fmt::format("the times in '{}' are uneven, and --interpolation smooth needs evenly spaced rows; add --rate {:.5g}Hz "
                        "to take them as evenly spaced, or use --interpolation linear",
                        name, 1 / times.mean_step()));
    out.uses_row_times = true;
    out.notes.push_back(
        fmt::format("the uneven times in '{}' ({}) were interpolated at {}", name, step_range(times), hertz(*options.resample)));
    return make_clock(*options.resample, times.first());
}

/// The clock of a table whose times cannot be read because of `problem`, if --rate is given: the rows start at 0 s. Adds a note with the
/// problem, but without the remedy at the end of its message.
Result<RowClock> without_times(Table& table, double rate, const Error& problem, RowClock& out) {
    TRY(table.rewind());
    out.notes.push_back(fmt::format("the times were ignored ({}); the recording starts at 0 s",
                                    problem.message.substr(0, std::min({problem.message.find("; --"), problem.message.find("; use "),
                                                                        problem.message.find("; give ")}))));
    out.clock = TRY(make_clock(rate));
    return out;
}

/// Times without a unit are read as seconds. Adds a note if this gives a rate that is implausible for a force sensor. `is_dated` is true if
/// the times are known to be dates.
void note_implausible_seconds(const Column& column, const RecordingOptions& options, const Clock& clock, bool is_dated,
                              std::vector<std::string>& notes) {
    const double rate = clock.rate();
    if (!column.unit.empty() || options.time_unit || options.rate || is_dated || (rate >= 5 && rate <= 1e6)) return;
    const auto [unit, word] = rate > 1e6     ? std::pair{"min", "minutes"}
                              : rate >= 5e-3 ? std::pair{"ms", "milliseconds"}
                              : rate >= 5e-6 ? std::pair{"us", "microseconds"}
                                             : std::pair{"ns", "nanoseconds"};
    notes.push_back(fmt::format("no unit for '{}': assuming seconds, which gives a rate of {}; use --time-unit {} if they are {}{}",
                                column.name, hertz(rate), unit, word, rate > 1e6 ? ", or give the true rate with --rate" : ""));
}

/// Recognises times that are serial days of spreadsheets (from 1968 to 2118) or MATLAB (from 1889 to 2160). As seconds, such numbers would
/// give a rate above 100 kHz. `step` is the mean step of the times, `name` the name of their column.
bool find_serial_days(const std::vector<double>& times, double step, const std::string& name, RowClock& out) {
    const double first = times[0];
    const bool spreadsheet = first >= 25'000 && first < 80'000, matlab = first >= 690'000 && first < 790'000;
    if (!(spreadsheet || matlab) || !(step > 0 && step < 1e-5)) return false;
    constexpr double day = 86'400;  // s
    out.seconds_per_unit = day, out.origin = first;
    out.notes.push_back(fmt::format("the times in '{}' are serial days of {}; 0 s is {}, the first time", name,
                                    spreadsheet ? "a spreadsheet" : "MATLAB",
                                    format_instant((first - (spreadsheet ? 25'569 : 719'529)) * day)));
    return true;
}

/// Recognises times since 1970 in s, ms, us or ns by their magnitude (dates from 2001 to 2065) and their step, and serial days. Sets the
/// origin in `out` so that the first time becomes 0 s. `unit` is the unit of the column in s; if `unit_is_known` is false, the times
/// determine it.
Result<void> find_epoch(Table& table, std::size_t column, double unit, bool unit_is_known, RowClock& out) {
    std::vector<std::vector<double>> first(1);
    const auto rows = table.read({column}, 64, first);
    TRY(table.rewind());
    if (!rows) return {};  // check_times() will report the error
    std::vector<double> times;
    for (std::size_t k = 0; k < *rows; ++k)
        if (std::isfinite(first[0][k])) times.push_back(first[0][k]);
    if (times.size() < 2) return {};
    const double step = (times.back() - times[0]) / static_cast<double>(times.size() - 1);
    if (!unit_is_known && find_serial_days(times, step, table.columns()[column].name, out)) return {};
    for (const auto& [name, seconds] : {std::pair{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}) {
        const double factor = unit_is_known ? unit : seconds, since = times[0] * factor;
        if (!(since >= 1e9 && since < 3e9 && step >= 0 && step * factor <= 10)) continue;
        out.seconds_per_unit = factor, out.origin = times[0];
        out.notes.push_back(fmt::format("the times in '{}' are {} since 1970; 0 s is {} (UTC), the first time",
                                        table.columns()[column].name, unit_is_known ? "counted" : name, format_instant(since)));
        return {};
    }
    return {};
}

}  // namespace

void ClockAnalysis::add(double t) {
    const Point p{static_cast<double>(count_), t};
    if (upper_.empty()) {
        first_ = p;
    } else {
        const double step = t - last_.t;
        const bool is_first_step = last_.k == first_.k;
        min_step_ = is_first_step ? step : std::min(min_step_, step);
        max_step_ = is_first_step ? step : std::max(max_step_, step);
        steps_.add(step);
    }
    // Adds p to one side of the hull. `sign` is 1 for the upper and -1 for the lower side.
    const auto push = [&](std::vector<Point>& side, double sign) {
        // True if b is not a corner of the hull of a, b and the new point p.
        const auto inside = [&](Point a, Point b) { return sign * ((b.k - a.k) * (p.t - a.t) - (b.t - a.t) * (p.k - a.k)) >= 0; };
        while (side.size() >= 2 && inside(side[side.size() - 2], side.back())) side.pop_back();
        side.push_back(p);
        if (side.size() > max_points) thin(side);
    };
    push(upper_, 1);
    push(lower_, -1);
    last_ = p;
    ++count_;
}

double ClockAnalysis::peak_to_peak_jitter() const {
    if (last_.k == first_.k) return 0;
    const double step = mean_step();
    const auto deviation = [&](Point p) { return p.t - first_.t - p.k * step; };
    double late = 0, early = 0;  // s, the largest deviations in both directions
    for (const auto& p : upper_) late = std::max(late, deviation(p));
    for (const auto& p : lower_) early = std::min(early, deviation(p));
    return late - early;
}

Result<Clock> ClockAnalysis::clock() const {
    const double length = last_.t - first_.t;  // s
    return make_clock(1 / mean_step(), first_.t, std::clamp(peak_to_peak_jitter() / length, 1e-12, 1e-2));
}

Result<RowClock> find_row_clock(Table& table, const RecordingOptions& options, const std::string& path, std::optional<std::size_t> column,
                                const std::vector<std::size_t>& channels) {
    RowClock out;
    if (!column) {
        const auto rate = options.rate ? options.rate : table.info().rate;
        if (!rate) {
            std::vector<std::string> names;
            for (const auto& c : table.columns()) names.push_back(c.name);
            if (names.size() > 12) names.resize(12), names.push_back("...");
            return bad_input(
                fmt::format("no time column found (columns: {}); name one with --time, or give a rate, such as --rate 1kHz", joined(names)),
                {path});
        }
        out.clock = TRY(make_clock(*rate, options.rate ? 0 : table.info().start));
        return out;
    }
    out.time_column = column;
    if (!options.time && table.info().is_time_guessed)
        out.notes.push_back("no header: the first column increases evenly and is taken as the time (use --time none if it is a channel)");
    const auto unit = seconds_per_unit(table.columns()[*out.time_column], options, path);
    const bool drops_rows = options.bad_fields == BadFields::drop;
    if (unit) {
        const auto& heading = table.columns()[*column];
        out.seconds_per_unit = *unit;
        if (options.time_unit && !heading.unit.empty() && *options.time_unit != heading.unit)
            out.notes.push_back(
                fmt::format("--time-unit {} overrides the unit of '{}' in the header, {}", *options.time_unit, heading.name, heading.unit));
        RowReader rows(table, options, {}, column);  // sets whether the table allows gaps
        if (!heading.holds_time_stamps) TRY(find_epoch(table, *column, *unit, options.time_unit || !heading.unit.empty(), out));
    }
    const auto times =
        unit ? check_times(table, RowReader(table, options, drops_rows ? channels : std::vector<std::size_t>(), column), out, options)
             : Result<TimeCheck>(unit.error());
    if (!times && times.error().code == ErrorCode::interrupted) return times.error();
    if (!times && options.rate) return without_times(table, *options.rate, times.error(), out);
    if (!times) return times.error();
    if (times->count() < 1 && options.rate && drops_rows)
        return without_times(table, *options.rate, bad_input(fmt::format("'{}' holds no times", table.columns()[*column].name)), out);
    out.drops_untimed = drops_rows;
    if (times->gap_count() * 20 < times->count()) out.gap_count = times->gap_count();  // long steps are not gaps if they are frequent
    if (times->count() < 1) return bad_input("no data in this file", {path});
    const auto& name = table.columns()[*out.time_column].name;
    auto clock = options.rate ? clock_by_rate(*options.rate, name, *times, out.notes) : clock_by_times(name, *times, options, out);
    if (!clock)
        return bad_input(clock.error().message, clock.error().location.file.empty() ? SourceLocation{path} : clock.error().location);
    out.clock = *clock;
    note_implausible_seconds(table.columns()[*out.time_column], options, out.clock, out.origin != 0, out.notes);
    return out;
}

}  // namespace corpuscle
