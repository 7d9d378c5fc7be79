#pragma once
// Determines when each row of a table was sampled, from its time column, or from the rate that the user or the file states.

#include "io/quality/log_histogram.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle {

/// Tests in one pass whether the times t_k of samples k = 0, 1, 2 ... are evenly spaced. Only points (k, t_k) on the convex hull of all
/// points can be farthest from a straight line, so only these are stored.
class ClockAnalysis {
    struct Point {
        double k, t;  // index of the sample, and its time in s
    };
    // Limit on the number of points of each side of the hull. If a clock becomes slower and slower, all its times are on the hull.
    static constexpr std::size_t max_points = std::size_t{1} << 16;
    std::vector<Point> upper_, lower_;    // the two sides of the hull
    Point first_{}, last_{};              // the first and the latest sample with a known time
    LogHistogram steps_;                  // intervals between samples with known times
    double min_step_ = 0, max_step_ = 0;  // s
    std::int64_t count_ = 0;              // all samples so far

public:
    /// Adds the next sample, at time t in s.
    void add(double t);
    /// Adds the next sample if its time is not known.
    void skip() { ++count_; }

    /// The number of samples.
    std::int64_t count() const { return count_; }
    /// The number of steps (intervals between samples with known times) longer than 1.5 times the median step.
    std::int64_t gap_count() const { return steps_.count_above(1.5 * steps_.median(steps_.count())); }
    double first() const { return first_.t; }  ///< s, the first known time
    /// The mean, smallest and largest step, s. The smallest is negative if the time decreased.
    double mean_step() const { return (last_.t - first_.t) / (last_.k - first_.k); }
    double min_step() const { return min_step_; }
    double max_step() const { return max_step_; }
    /// The peak-to-peak deviation in s of the times from an even clock with the mean step.
    double peak_to_peak_jitter() const;
    /// True if the times never decrease, and deviate from an even clock by at most one mean step, peak to peak.
    bool is_even() const { return count_ >= 2 && min_step_ >= 0 && mean_step() > 0 && peak_to_peak_jitter() <= mean_step(); }
    /// The clock that begins at the first known time, with the simplest rate that is consistent with the times.
    Result<Clock> clock() const;
};

struct RowClock {
    std::optional<std::size_t> time_column;  ///< nullopt: the table has none
    double seconds_per_unit = 1;             ///< the unit of the time column, in s
    double origin = 0;                       ///< the value in the time column that becomes 0 s
    bool uses_row_times = false;             ///< true: each row has its own time, because the times are uneven; false: rows follow `clock`
    bool drops_untimed = false;              ///< true: rows whose time cannot be read are dropped
    Clock clock;                             ///< of the rows; with uses_row_times, of the resampled samples
    std::int64_t gap_count = 0;  ///< number of time steps longer than 1.5 times the median step; 0 if more than one step in 20 is so long
    std::vector<std::string> notes;  ///< notes for the user about the times

    /// The time in s of a value in the time column.
    double seconds(double time) const { return (time - origin) * seconds_per_unit; }
};

/// Determines the clock of the rows. `column` is the index of the time column, if there is one: the function then reads all times and
/// rewinds the table. Uneven times are an error unless the options give `rate` or `resample`. If the options drop rows with a bad value,
/// the times of rows that are dropped because of a value in `channels` (indices of columns) are ignored.
Result<RowClock> find_row_clock(Table&, const RecordingOptions&, const std::string& path, std::optional<std::size_t> column,
                                const std::vector<std::size_t>& channels);

}  // namespace corpuscle
