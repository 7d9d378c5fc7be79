#pragma once
// Tests in one pass whether times are evenly spaced. Only points (k, t_k) on the convex hull can be farthest from a straight line, so
// only these are stored.

#include <cstdint>
#include <vector>

#include "io/log_histogram.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

class ClockAnalysis {
    struct Point {
        double k, t;
    };
    // Limit on the points of each side of the hull. The times of a steadily slowing clock would all be on the hull.
    static constexpr std::size_t max_points = std::size_t{1} << 16;
    std::vector<Point> upper_, lower_;
    Point first_{}, last_{};
    LogHistogram steps_;
    bool has_samples_ = false;
    double min_step_ = 0, max_step_ = 0;
    std::int64_t count_ = 0;

public:
    void add(double t);
    /// Counts a sample without a known time.
    void skip() { ++count_; }

    std::int64_t count() const { return count_; }
    /// The number of steps longer than 1.5 times the median step.
    std::int64_t gap_count() const { return steps_.count_above(1.5 * steps_.median(steps_.count())); }
    double first() const { return first_.t; }
    double mean_step() const { return (last_.t - first_.t) / (last_.k - first_.k); }
    double min_step() const { return min_step_; }  ///< negative if the time decreased
    double max_step() const { return max_step_; }
    /// The peak-to-peak deviation of the times from the mean clock, in s.
    double peak_to_peak_jitter() const;
    /// True if no sample deviates by more than half a step.
    bool is_even() const { return count_ >= 2 && min_step_ >= 0 && mean_step() > 0 && peak_to_peak_jitter() <= mean_step(); }
    /// The clock with the simplest rate that is consistent with the times.
    Result<Clock> clock() const;
};

}  // namespace corpuscle
