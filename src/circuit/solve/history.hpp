#pragma once
// The last accepted points of a transient, the polynomials through them, and the polynomial that interpolates between the two newest ones.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "circuit/solve/step_control.hpp"

namespace corpuscle::circuit {

/// The unknowns x and the charge q of each equation (C, or V s for an inductor) at time t (s).
struct TimePoint {
    double t = 0;
    std::vector<double> x, q;
};

/// Weights of the values of a quantity at some times, newest first. The weighted sum is the value, derivative or error of the polynomial
/// through the values.
using HistoryWeights = std::array<double, 7>;
/// For the value of the polynomial at t.
HistoryWeights weights_of_value(std::span<const double> times, double t);
/// For the derivative at t of the polynomial through these points and a new one at t: `leading` (1/s) times the new value plus the weighted
/// sum.
HistoryWeights weights_of_slope(std::span<const double> times, double t, double& leading);
/// For the error, half way between the first two times, of the polynomial through all points but the last. The estimate is the difference
/// to the polynomial through all points.
HistoryWeights weights_of_interpolation_error(std::span<const double> times);

/// The last accepted points, newest first.
class History {
public:
    static constexpr int max_points = std::tuple_size_v<HistoryWeights>;

    void clear() { count_ = smooth_count_ = 0; }
    /// After this call the integration formula uses the newest point only. `forget`: the earlier points do not lie on one smooth curve with
    /// it, either.
    void restart(bool forget) { count_ = std::min(count_, 1), smooth_count_ = forget ? count_ : smooth_count_; }
    int count() const { return count_; }                ///< points that the integration formula may use
    int smooth_count() const { return smooth_count_; }  ///< newest points that lie on one smooth curve, at least count()
    void set_counts(int count, int smooth_count) { count_ = count, smooth_count_ = smooth_count; }
    /// Point k, from 0 for the newest.
    const TimePoint& operator[](int k) const { return ring_[static_cast<std::size_t>((first_ + k) % capacity)]; }
    TimePoint& operator[](int k) { return ring_[static_cast<std::size_t>((first_ + k) % capacity)]; }
    /// Storage for the next point: fill it, then call accept().
    TimePoint& next_point() { return ring_[static_cast<std::size_t>((first_ + capacity - 1) % capacity)]; }
    void accept();
    /// Adds factor * charge to the charges of all points.
    void add_to_charges(std::span<const double> charge, double factor) {
        for (int k = 0; k < smooth_count_; ++k)
            for (std::size_t n = 0; n < charge.size(); ++n) (*this)[k].q[n] += factor * charge[n];
    }
    /// Moves the origin of time to `t`, s.
    void shift_origin(double t) {
        for (auto& point : ring_) point.t -= t;
    }

    /// The times of the smooth_count() newest points; then zeros.
    std::array<double, max_points> times() const;
    using Weights = HistoryWeights;
    /// weights_of_value() for the newest `points` points.
    Weights value_weights(double t, int points) const;
    /// weights_of_slope() for the newest `order` points.
    Weights slope_weights(double t, int order, double& leading) const;

    /// Writes the weighted sum of a member (&TimePoint::x or &TimePoint::q) of the `points` newest points to `out`.
    void combine(const Weights&, int points, std::vector<double> TimePoint::* member, std::span<double> out) const;

private:
    static constexpr int capacity = max_points + 1;
    std::array<TimePoint, capacity> ring_;
    int first_ = 0;  // index in ring_ of the newest point; older points follow
    int count_ = 0, smooth_count_ = 0;
};

/// A polynomial through the newest points, and its error.
struct Interpolant {
    int points = 2;    ///< number of points that the polynomial passes through
    double error = 0;  ///< error at mid-step, relative to the allowed error of an interpolation

    /// Factor of the tolerance of currents in the simulation of an afferent, where currents are only plotted. On lanes the linearized
    /// current of a transistor has an error above `reltol`.
    static constexpr double current_tolerance_factor = 10;
};

/// Chooses the polynomial. `times` are those of the newest point, then of the `smooth_count` points that lie on one smooth curve with it.
/// The function worst_of(weights, points) must return the largest weighted sum of an unknown's values at the newest `points` + 1 points,
/// relative to its allowed error. With only two points there is no estimate; the error is 0.
template <class WorstOf>
Interpolant best_interpolant(std::span<const double> times, int smooth_count, const WorstOf& worst_of) {
    constexpr double good_enough = 0.05;  // relative error at which no other number of points is tried
    Interpolant best;
    bool found = false;
    for (const int points : {4, 3, 2, StepControl::max_curve_points}) {
        if (points > smooth_count) continue;
        const double error = worst_of(weights_of_interpolation_error(times.first(static_cast<std::size_t>(points) + 1)), points) /
                             StepControl::curve_tolerance;
        if (!found || error < best.error) best = {points, error}, found = true;
        if (best.error < good_enough) break;
    }
    return best;
}

/// Finds the crossing by bisection, and returns a time at which f > 0. Returns nothing unless f(from) <= 0 and f(to) > 0.
template <class Function>
std::optional<double> bisect_crossing(double from, double to, const Function& f) {
    if (!(f(from) <= 0 && f(to) > 0)) return {};
    for (int k = 0; k < 50; ++k) {
        const double half = from + (to - from) / 2;
        f(half) > 0 ? to = half : from = half;
    }
    return to;
}

/// The same with known values at both ends, f_from and f_to. Unless f rises from below zero to above, it may still cross zero twice in the
/// interval. If one of the two values is closer to zero than to the other value, four subintervals are therefore searched.
template <class Function>
std::optional<double> find_crossing(double from, double to, double f_from, double f_to, const Function& f) {
    if (f_from <= 0 && f_to > 0) return bisect_crossing(from, to, f);
    if (std::min(std::abs(f_from), std::abs(f_to)) > std::abs(f_to - f_from)) return {};
    constexpr int parts = 4;
    for (int k = 0; k < parts; ++k) {
        const double a = from + (to - from) * k / parts, b = k + 1 < parts ? from + (to - from) * (k + 1) / parts : to;
        if (const auto found = bisect_crossing(a, b, f)) return found;
    }
    return {};
}

}  // namespace corpuscle::circuit
