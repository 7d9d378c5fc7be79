#pragma once
// The last accepted points of a transient, and the polynomials through them.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace corpuscle::circuit {

/// An accepted point in time (s): the unknowns and the charge (C) of each equation.
struct Moment {
    double t = 0;
    std::vector<double> x, q;
};

/// Weights of the values at some times, newest first. The weighted sum is a property of the polynomial through these points.
using PastWeights = std::array<double, 7>;
/// The value of the polynomial at t.
PastWeights weights_of_value(std::span<const double> times, double t);
/// The derivative at t of the polynomial through these points and a new one at t: `leading` times the new value plus the weighted sum.
PastWeights weights_of_slope(std::span<const double> times, double t, double& leading);
/// The error estimate half way between the first two times: the difference between the polynomials without and with the last point.
PastWeights weights_of_bend(std::span<const double> times);

/// The newest points, newest first.
class Past {
public:
    static constexpr int most = std::tuple_size_v<PastWeights>;  ///< points

    void clear() { count_ = seen_ = 0; }
    /// Integration continues from the newest point only. `forget`: the earlier points are not on its smooth curve, either.
    void start_over(bool forget) { count_ = std::min(count_, 1), seen_ = forget ? count_ : seen_; }
    int count() const { return count_; }  ///< points that the integration formula may use
    int seen() const { return seen_; }    ///< points that lie on one smooth curve, at least count()
    /// Sets the number of points that the integration formula may use.
    void count_only(int count) { count_ = std::clamp(count, std::min(seen_, 1), seen_); }
    const Moment& operator[](int k) const { return ring_[static_cast<std::size_t>((first_ + k) % room)]; }
    Moment& newest() { return ring_[static_cast<std::size_t>(first_)]; }
    /// Storage for the next point: fill it, then call accept().
    Moment& next() { return ring_[static_cast<std::size_t>((first_ + room - 1) % room)]; }
    void accept();

    std::array<double, most> times() const;
    using Weights = PastWeights;
    /// weights_of_value() for the newest `points` points.
    Weights value(double t, int points) const;
    /// weights_of_slope() for the newest `order` points.
    Weights slope(double t, int order, double& leading) const;

    /// Writes the weighted sum of a member (&TimePoint::x or &TimePoint::q) of the newest points to `out`.
    void sum(const Weights&, int points, std::vector<double> Moment::*member, std::span<double> out) const;

private:
    static constexpr int room = most + 1;
    std::array<Moment, room> ring_;
    int first_ = 0, count_ = 0, seen_ = 0;
};

}  // namespace corpuscle::circuit
