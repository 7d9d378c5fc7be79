#pragma once
// The last points of a transient, and the polynomials through them.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace corpuscle::circuit {

/// One point in time: unknowns, and the charge of each unknown's equation.
struct Moment {
    double t = 0;
    std::vector<double> x, q;
};

/// Weights of values at some times, newest first, that give what the polynomial through them has elsewhere.
using PastWeights = std::array<double, 7>;
/// Its value at t.
PastWeights weights_of_value(std::span<const double> times, double t);
/// Its slope at t, if it goes through a point there, too: leading times that one's value plus these.
PastWeights weights_of_slope(std::span<const double> times, double t, double& leading);
/// Half way between the first two times, how far the polynomial through all but the last point is from the one through all of them: an
/// estimate of its error there.
PastWeights weights_of_bend(std::span<const double> times);

/// The newest points, newest first; where time has come from and, to some order, where it is going.
class Past {
public:
    static constexpr int most = std::tuple_size_v<PastWeights>;  ///< points

    void clear() { count_ = seen_ = 0; }
    /// From now on only the newest point counts. `forget`: nor is there a curve through those before it.
    void start_over(bool forget) { count_ = std::min(count_, 1), seen_ = forget ? count_ : seen_; }
    int count() const { return count_; }  ///< points that the rule of a step may use
    int seen() const { return seen_; }    ///< points that lie on one smooth curve, as many as these or more
    /// Of the points accepted so far, as many as these count.
    void count_only(int count) { count_ = std::clamp(count, std::min(seen_, 1), seen_); }
    const Moment& operator[](int k) const { return ring_[static_cast<std::size_t>((first_ + k) % room)]; }
    Moment& newest() { return ring_[static_cast<std::size_t>(first_)]; }
    /// Room for the next point, to be filled and then taken by accept().
    Moment& next() { return ring_[static_cast<std::size_t>((first_ + room - 1) % room)]; }
    void accept();

    std::array<double, most> times() const;
    using Weights = PastWeights;
    /// Of the newest `points`: what the polynomial through them is at t.
    Weights value(double t, int points) const;
    /// Of the newest `order`: with them and a point at t, the polynomial's slope at t is leading times the new value plus these.
    Weights slope(double t, int order, double& leading) const;

    /// Sum of weights times values (member: &Moment::x or &Moment::q), into `out`.
    void sum(const Weights&, int points, std::vector<double> Moment::* member, std::span<double> out) const;

private:
    static constexpr int room = most + 1;
    std::array<Moment, room> ring_;
    int first_ = 0, count_ = 0, seen_ = 0;
};

}  // namespace corpuscle::circuit
