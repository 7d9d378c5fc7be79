#pragma once
// The last accepted points of a transient, and the polynomials through them.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

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

}  // namespace corpuscle::circuit
