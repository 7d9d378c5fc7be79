#pragma once
// Are these times those of an even clock? One pass, whatever the length: of all points (k, t_k) only those on the two sides
// of their convex hull can lie farthest from a straight line.

#include <cstdint>
#include <vector>

#include "signal/clock.hpp"

namespace corpuscle {

class ClockCheck {
    struct Point {
        double k, t;
    };
    std::vector<Point> upper_, lower_;
    Point first_{}, last_{};
    double least_step_ = 0, longest_step_ = 0;
    std::int64_t count_ = 0;

public:
    void add(double t);

    std::int64_t count() const { return count_; }
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
