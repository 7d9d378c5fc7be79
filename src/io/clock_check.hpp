#pragma once
// Are these times those of an even clock? One pass, whatever the length: of all points (k, t_k) only those on the two sides
// of their convex hull can lie farthest from a straight line.

#include <cstdint>
#include <vector>

#include "io/log_histogram.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

class ClockCheck {
    struct Point {
        double k, t;
    };
    static constexpr std::size_t most_points = std::size_t{1} << 16;  // of a side; a clock that slows steadily would put every sample there
    std::vector<Point> upper_, lower_;
    Point first_{}, last_{};
    LogHistogram steps_;
    bool begun_ = false;
    double least_step_ = 0, longest_step_ = 0;
    std::int64_t count_ = 0;

public:
    void add(double t);
    /// A sample whose time is not known.
    void skip() { ++count_; }

    std::int64_t count() const { return count_; }
    /// Steps longer than one and a half times the median step.
    std::int64_t gaps() const { return steps_.above(1.5 * steps_.median(steps_.count())); }
    double first() const { return first_.t; }
    double mean_step() const { return (last_.t - first_.t) / (last_.k - first_.k); }
    double least_step() const { return least_step_; }  ///< negative if time went back
    double longest_step() const { return longest_step_; }
    /// From the earliest to the latest that a sample comes, against the mean clock; s.
    double spread() const;
    /// Even: no sample is further than half a step from its place.
    bool even() const { return count_ >= 2 && least_step_ >= 0 && mean_step() > 0 && spread() <= mean_step(); }
    /// The simplest rate that these times do not contradict.
    Result<Clock> clock() const;
};

}  // namespace corpuscle
