#include "io/recording/clock_analysis.hpp"

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

}  // namespace

void ClockAnalysis::add(double t) {
    const Point p{static_cast<double>(count_), t};
    if (!has_samples_) {
        first_ = p;
    } else {
        const double step = t - last_.t;
        const bool is_first_step = last_.k == first_.k;
        min_step_ = is_first_step ? step : std::min(min_step_, step);
        max_step_ = is_first_step ? step : std::max(max_step_, step);
        steps_.add(step);
    }
    has_samples_ = true;
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

}  // namespace corpuscle
