// A transient between the points of its steps.

#include <algorithm>
#include <cmath>

#include "circuit/solve/crossing.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

double Transient::between(double t, int unknown) const {
    if (unknown < 0) return 0;
    const int points = points_between();
    const auto w = past_.value(t, points);
    double sum = 0;
    for (int k = 0; k < points; ++k) sum += w[static_cast<std::size_t>(k)] * past_[k].x[static_cast<std::size_t>(unknown)];
    return sum;
}

void Transient::between(double t, std::span<double> x) const {
    const int points = points_between();
    past_.sum(past_.value(t, points), points, &Moment::x, x);
}

/// The last step, in so many parts that straight lines between them will do.
bool Transient::tell(const Each& each) {
    constexpr double straight = 3;  // allowed units
    const double t0 = past_[1].t, t1 = past_[0].t;
    auto& x = error_;
    between((t0 + t1) / 2, x);
    double bulge = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
        if (allowed_[n] > 0) bulge = std::max(bulge, std::abs(x[n] - (past_[0].x[n] + past_[1].x[n]) / 2) / allowed_[n]);
    const int parts = static_cast<int>(std::min(std::ceil(std::sqrt(bulge / straight)), 1000.0));
    for (int k = 1; k < parts; ++k) {
        const double t = t0 + (t1 - t0) * k / parts;
        between(t, x);
        if (!each(t, x)) return false;
    }
    return each(t1, past_[0].x);
}

std::optional<double> Transient::crossing(int plus, int minus, double level, bool upwards) const {
    if (past_.count() < 2) return {};
    const double sign = upwards ? 1 : -1;
    const auto above = [&](double t) { return sign * (between(t, plus) - between(t, minus) - level); };
    return crossing_between(past_[1].t, past_[0].t, above);
}

}  // namespace corpuscle::circuit
