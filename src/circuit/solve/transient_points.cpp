// Interpolation of a transient between its accepted points.

#include <algorithm>
#include <cmath>
#include <utility>

#include "circuit/solve/crossing.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// Finds the nodes that a chain of voltage sources connects to ground, at least one of them time-dependent. Sources with a force input are
/// not included, since the force of later blocks is not known yet.
void Transient::find_held() {
    const auto count = static_cast<std::size_t>(system_.size());
    held_.clear(), held_at_.assign(count, -1), curves_.clear();
    std::vector<char> known(count + 1);  // the last element is ground
    known[count] = 1;
    const auto& elements = system_.circuit().elements;
    for (bool more = true; std::exchange(more, false);)
        for (std::size_t k = 0; k < elements.size(); ++k) {
            if (elements[k].letter != 'v' || elements[k].waveform.shape == Waveform::Shape::force) continue;
            const Device& d = *system_.devices()[k];
            const auto at = [&](int u) { return u < 0 ? count : static_cast<std::size_t>(u); };
            const bool plus = known[at(d.unknowns[0])] != 0, minus = known[at(d.unknowns[1])] != 0;
            if (plus == minus) continue;
            const int u = d.unknowns[plus ? 1 : 0], base = d.unknowns[plus ? 0 : 1];
            known[at(u)] = 1, more = true;
            if (!d.varies() && (base < 0 || held_at_[at(base)] < 0)) continue;
            held_at_[at(u)] = static_cast<int>(held_.size());
            held_.push_back({u, base, &d, plus ? -1.0 : 1.0});
        }
    const auto add = [&](int u) {
        if (u < 0 || held_at_[static_cast<std::size_t>(u)] >= 0 || std::find(curves_.begin(), curves_.end(), u) != curves_.end()) return;
        if (plan_.method == Integration::bdf || system_.is_voltage(u)) curves_.push_back(u);  // currents ring with the trapezoidal rule
    };
    for (const int u : plan_.reported) add(u);
    for (int u = 0; plan_.all_reported && u < system_.size(); ++u) add(u);
}

double Transient::held(const Held& h, double t) const {
    const double zero[3] = {};
    double f[3] = {}, q[3] = {}, df[9] = {}, dq[9] = {};
    h.source->eval(zero, {t, 1, newton_.instant.gmin, false}, {f, q, df, dq});
    const double base = h.base < 0 ? 0 : given(t, h.base).value_or(past_[0].x[static_cast<std::size_t>(h.base)]);
    return base - h.sign * f[2];
}

std::optional<double> Transient::given(double t, int unknown) const {
    if (unknown < 0 || held_at_[static_cast<std::size_t>(unknown)] < 0) return {};
    return held(held_[static_cast<std::size_t>(held_at_[static_cast<std::size_t>(unknown)])], t);
}

double Transient::between(double t, int unknown) const {
    if (unknown < 0) return 0;
    if (const auto source = given(t, unknown)) return *source;
    const int points = points_between();
    const auto w = past_.value(t, points);
    double sum = 0;
    for (int k = 0; k < points; ++k) sum += w[static_cast<std::size_t>(k)] * past_[k].x[static_cast<std::size_t>(unknown)];
    return sum;
}

void Transient::between(double t, std::span<double> x) const {
    const int points = points_between();
    past_.sum(past_.value(t, points), points, &Moment::x, x);
    for (const auto& h : held_) x[static_cast<std::size_t>(h.unknown)] = held(h, t);
}

/// Passes the last step to the callback, with enough intermediate points for linear interpolation.
bool Transient::tell(const Each& each) {
    constexpr double linear_tolerance = 2;  // error of linear interpolation, relative to the allowed error
    const double t0 = past_[1].t, t1 = past_[0].t;
    if (plan_.steps_only) return each(t1, past_[0].x);
    auto& x = error_;
    double deviation = 0;
    for (const double part : {0.25, 0.75}) {
        between(t0 + part * (t1 - t0), x);
        for (std::size_t n = 0; n < x.size(); ++n) {
            const double tolerance = plan_.all_reported ? may_err_[n] + noise(static_cast<int>(n)) : allowed_[n];
            const double line = past_[1].x[n] + part * (past_[0].x[n] - past_[1].x[n]);
            if (tolerance > 0) deviation = std::max(deviation, 4.0 / 3 * std::abs(x[n] - line) / tolerance);
        }
    }
    const int parts = static_cast<int>(std::min(std::ceil(std::sqrt(deviation / linear_tolerance)), 1000.0));
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
    const auto at = [&](int k, int u) { return u < 0 ? 0 : past_[k].x[static_cast<std::size_t>(u)]; };
    const auto end = [&](int k) { return sign * (at(k, plus) - at(k, minus) - level); };
    const auto above = [&](double t) { return sign * (between(t, plus) - between(t, minus) - level); };
    return crossing_within(past_[1].t, past_[0].t, end(1), end(0), above);
}

}  // namespace corpuscle::circuit
