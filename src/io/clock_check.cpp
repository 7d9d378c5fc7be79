#include "io/clock_check.hpp"

#include <algorithm>

namespace corpuscle {

void ClockCheck::add(double t) {
    const Point p{static_cast<double>(count_), t};
    if (count_ == 0) first_ = p;
    if (count_ >= 1) {
        const double step = t - last_.t;
        least_step_ = count_ == 1 ? step : std::min(least_step_, step);
        longest_step_ = count_ == 1 ? step : std::max(longest_step_, step);
    }
    const auto push = [&](std::vector<Point>& side, double sign) {
        const auto inside = [&](Point a, Point b) { return sign * ((b.k - a.k) * (p.t - a.t) - (b.t - a.t) * (p.k - a.k)) >= 0; };
        while (side.size() >= 2 && inside(side[side.size() - 2], side.back())) side.pop_back();
        side.push_back(p);
    };
    push(upper_, 1);
    push(lower_, -1);
    last_ = p;
    ++count_;
}

double ClockCheck::spread() const {
    if (count_ < 2) return 0;
    const double step = mean_step();
    const auto off = [&](Point p) { return p.t - first_.t - p.k * step; };
    double late = 0, early = 0;
    for (const auto& p : upper_) late = std::max(late, off(p));
    for (const auto& p : lower_) early = std::min(early, off(p));
    return late - early;
}

Result<Clock> ClockCheck::clock() const {
    const double length = last_.t - first_.t;
    return clock_of(1 / mean_step(), first_.t, std::clamp(spread() / length, 1e-12, 1e-2));
}

}  // namespace corpuscle
