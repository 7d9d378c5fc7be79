// Interpolation of a transient between its accepted points.

#include "circuit/devices.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// Finds the nodes that a chain of voltage sources connects to ground, where at least one of the sources is time-dependent. Sources with a
/// force input are not included, since the force of later blocks is not known yet. Then lists the interpolated unknowns.
void Transient::find_source_nodes() {
    const auto count = static_cast<std::size_t>(system_.size());
    source_nodes_.clear(), source_node_index_.assign(count, -1), interpolated_unknowns_.clear();
    std::vector<char> known(count + 1);  // by unknown, 1 if sources define its voltage; the last element is ground
    known[count] = 1;
    const auto& elements = system_.circuit().elements;
    for (bool more = true; std::exchange(more, false);)
        for (std::size_t k = 0; k < elements.size(); ++k) {
            if (!has_role(elements[k], Role::voltage_source) || elements[k].waveform.shape == Waveform::Shape::force) continue;
            const Device& d = *system_.devices()[k];
            const auto at = [&](int u) { return u < 0 ? count : static_cast<std::size_t>(u); };
            const bool plus = known[at(d.unknowns[0])] != 0, minus = known[at(d.unknowns[1])] != 0;
            if (plus == minus) continue;
            const int u = d.unknowns[plus ? 1 : 0], base = d.unknowns[plus ? 0 : 1];
            known[at(u)] = 1, more = true;
            if (!d.is_time_dependent() && (base < 0 || source_node_index_[at(base)] < 0)) continue;
            source_node_index_[at(u)] = static_cast<int>(source_nodes_.size());
            source_nodes_.push_back({u, base, &d, plus ? -1.0 : 1.0});
        }
    std::vector<char> added(count);
    const auto add_interpolated = [&](int u) {
        if (u < 0 || source_node_index_[static_cast<std::size_t>(u)] >= 0 || std::exchange(added[static_cast<std::size_t>(u)], 1)) return;
        if (plan_.method == Integration::bdf || system_.is_voltage(u))
            interpolated_unknowns_.push_back(u);  // currents ring with the trapezoidal rule
    };
    for (const int u : plan_.reported) add_interpolated(u);
    for (int u = 0; plan_.all_reported && u < system_.size(); ++u) add_interpolated(u);
}

double Transient::source_node_voltage(const SourceNode& node, double t) const {
    const double zero[3] = {};
    double f[3] = {}, q[3] = {}, df[9] = {}, dq[9] = {};
    node.source->eval(zero, {t, 1, newton_.context.gmin, false}, {f, q, df, dq});
    const double base = source_voltage(t, node.base).value_or(value_of(history_points_[0].x, node.base));
    return base - node.sign * f[2];  // with all unknowns 0, f[2] of a voltage source is minus its voltage
}

std::optional<double> Transient::source_voltage(double t, int unknown) const {
    if (unknown < 0 || source_node_index_[static_cast<std::size_t>(unknown)] < 0) return {};
    return source_node_voltage(source_nodes_[static_cast<std::size_t>(source_node_index_[static_cast<std::size_t>(unknown)])], t);
}

double Transient::interpolate(double t, int unknown) const {
    if (unknown < 0) return 0;
    if (const auto source = source_voltage(t, unknown)) return *source;
    const int points = interpolation_points();
    const auto w = history_points_.value_weights(t, points);
    double sum = 0;
    for (int k = 0; k < points; ++k) sum += w[static_cast<std::size_t>(k)] * history_points_[k].x[static_cast<std::size_t>(unknown)];
    return sum;
}

void Transient::interpolate(double t, std::span<double> x) const {
    const int points = interpolation_points();
    history_points_.combine(history_points_.value_weights(t, points), points, &TimePoint::x, x);
    for (const auto& node : source_nodes_) x[static_cast<std::size_t>(node.unknown)] = source_node_voltage(node, t);
}

/// Passes the last step to the callback, with enough intermediate points for linear interpolation. Returns false if the callback does.
bool Transient::emit_points(const PointCallback& each) {
    constexpr double linear_tolerance = 2;  // error of linear interpolation, relative to the allowed error
    const double t0 = history_points_[1].t, t1 = history_points_[0].t;
    if (plan_.steps_only) return each(t1, history_points_[0].x);
    auto& x = error_;
    double deviation = 0;
    for (const double part : {0.25, 0.75}) {
        interpolate(t0 + part * (t1 - t0), x);
        for (std::size_t n = 0; n < x.size(); ++n) {
            const double tolerance = plan_.all_reported ? tolerance_[n] + rounding_[n] : allowed_error_[n];
            const double line = history_points_[1].x[n] + part * (history_points_[0].x[n] - history_points_[1].x[n]);
            // A parabola's deviation from its chord at these points is 3/4 of the largest.
            if (tolerance > 0) deviation = std::max(deviation, 4.0 / 3 * std::abs(x[n] - line) / tolerance);
        }
    }
    const int parts = static_cast<int>(std::min(std::ceil(std::sqrt(deviation / linear_tolerance)), 1000.0));
    for (int k = 1; k < parts; ++k) {
        const double t = t0 + (t1 - t0) * k / parts;
        interpolate(t, x);
        if (!each(t, x)) return false;
    }
    return each(t1, history_points_[0].x);
}

std::optional<double> Transient::crossing(int plus, int minus, double level, bool upwards) const {
    if (history_points_.count() < 2) return {};
    const double sign = upwards ? 1 : -1;
    const auto at = [&](int k, int u) { return value_of(history_points_[k].x, u); };
    const auto end = [&](int k) { return sign * (at(k, plus) - at(k, minus) - level); };
    const auto above = [&](double t) { return sign * (interpolate(t, plus) - interpolate(t, minus) - level); };
    return find_crossing(history_points_[1].t, history_points_[0].t, end(1), end(0), above);
}

}  // namespace corpuscle::circuit
