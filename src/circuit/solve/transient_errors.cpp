// The errors of the steps of a transient: of the formula, of rounding and of interpolation.

#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// Converts error_ from an error of the equations to that of each unknown. Returns the largest of these, relative to the allowed error.
double Transient::worst_error() {
    equations_.solve_perturbation(error_);
    constexpr double uncharged_factor = 2;  // an unknown without charge may have a larger error, because this does not affect the next step
    // Stricter than for afferents: the sum of the errors of many steps stays below ten allowed errors. The errors of order 2 have one sign
    // for longer.
    const double sum_factor = order_limit_.is_limiting() ? 6 : 1.5;
    double worst = 0;
    uncharged_error_ = 0;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (has_charge_[n] && allowed_error_[n] > 0) worst = std::max(worst, std::abs(error_[n]) / (allowed_error_[n] + rounding_[n]));
    if (may_jump_ && plan_.all_reported && equations_.has_all_capacitances()) {
        uncharged_error_ = worst;
        worst = worst_error_of_charges();
    }
    if (plan_.all_reported) worst *= sum_factor;
    if (!plan_.all_reported || noise_ || plan_.method != Integration::bdf) return worst;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (!has_charge_[n] && tolerance_[n] > 0)
            uncharged_error_ = std::max(uncharged_error_, std::abs(error_[n]) / (uncharged_factor * (tolerance_[n] + rounding_[n])));
    return may_jump_ ? worst : std::max(worst, uncharged_error_);
}

/// The largest error of a charge for the errors of the unknowns in error_, relative to that of its unknown's allowed error. In a step with
/// a jump the voltages of nodes with charge may change, too, if no charge does: those of a capacitor with a resistance in series, when the
/// current into it changes.
double Transient::worst_error_of_charges() {
    charge_error_.resize(error_.size());
    equations_.charge_change(error_, charge_error_);
    double worst = 0;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (capacitance_[n] > 0 && allowed_error_[n] > 0)
            worst = std::max(worst, std::abs(charge_error_[n]) / (capacitance_[n] * (allowed_error_[n] + rounding_[n])));
    return worst;
}

/// Called before a step is rejected. Computes the error of each unknown that comes from the rounding of the charges, and computes `error`
/// and `curve_error` again with tolerances that are larger by this. It grows as the step gets shorter, most at nodes that are connected
/// only to capacitors.
void Transient::measure_rounding(double& error, double& curve_error) {
    if (!converged_ || !plan_.all_reported || std::max(error, curve_error) <= 1) return;
    measure_rounding();
    error = error_of(control_.order), curve_error = interpolation_error();
}

/// Computes rounding_ for the step just solved.
void Transient::measure_rounding() {
    constexpr double roundoff = 1e-15;
    const double t = history_points_.next_point().t;
    for (std::size_t n = 0; n < rounding_.size(); ++n)
        rounding_[n] = roundoff * std::abs(leading_) * (capacitance_[n] * voltage_scale_ + t * std::abs(rate_[n]));
    equations_.add_rounding(history_points_.next_point().x, rounding_);
    equations_.solve_perturbation(rounding_);
    for (std::size_t n = 0; n < rounding_.size(); ++n) {
        rounding_[n] = std::abs(rounding_[n]);
        charge_rounding_[n] = rounding_[n] / std::abs(leading_);
    }
}

/// True if the rounding error that measure_rounding() has found exceeds the tolerance of an unknown by far.
bool Transient::is_rounding_visible() {
    const auto& x = history_points_.next_point().x;
    for (std::size_t n = 0; n < rounding_.size(); ++n)
        if (tolerance_[n] > 0 && rounding_[n] > 100 * (tolerance_[n] + plan_.reltol * std::abs(x[n]))) return true;
    return false;
}

/// The interpolation error at the middle of the step just solved, relative to the allowed error. Sets curve_points_ to the number of points
/// with the smallest error. The first step after a breakpoint has no third point for an estimate; its error is 0.
double Transient::interpolation_error() {
    constexpr double convergence_ratio = 3;  // each higher degree must change the curve at least by this factor less than the one before
    constexpr double output_factor = 2.2;    // stricter than for afferents, since users draw straight lines between the points
    curve_points_ = noise_ ? 2 : 0;
    if (noise_ || interpolated_unknowns_.empty()) return 0;
    const auto& next = history_points_.next_point();
    std::array<double, History::max_points + 1> times{next.t};
    const auto before = history_points_.times();
    std::copy(before.begin(), before.end(), times.begin() + 1);
    std::array<const double*, History::max_points + 1> x{next.x.data()};
    for (int k = 0; k < history_points_.smooth_count(); ++k) x[static_cast<std::size_t>(k) + 1] = history_points_[k].x.data();
    auto& tolerance = error_;
    for (const int u : interpolated_unknowns_)
        tolerance[static_cast<std::size_t>(u)] = tolerance_[static_cast<std::size_t>(u)] + rounding_[static_cast<std::size_t>(u)];
    const auto worst_of = [&](const HistoryWeights& w, int points) {
        double worst = 0;
        for (const int u : interpolated_unknowns_) {
            const auto n = static_cast<std::size_t>(u);
            double sum = w[0] * x[0][n];
            for (std::size_t k = 1; k <= static_cast<std::size_t>(points); ++k) sum += w[k] * x[k][n];
            worst = std::max(worst, std::abs(sum) / tolerance[n]);
        }
        return worst;
    };
    const auto curve = best_interpolant(times, history_points_.smooth_count(), worst_of);
    curve_points_ = curve.points;
    if (!plan_.all_reported) return curve.error;
    // A small change with one more degree may be coincidence, so the next degree is checked as well.
    const int more = curve.points + 1;
    if (more > history_points_.smooth_count()) return output_factor * curve.error;
    const auto weights = weights_of_interpolation_error(std::span(times).first(static_cast<std::size_t>(more) + 1));
    return output_factor * std::max(curve.error, convergence_ratio * worst_of(weights, more) / StepControl::curve_tolerance);
}

/// The error that the step just solved would have if its order were `order`, relative to the allowed error.
double Transient::error_of(int order) {
    // Largest mean distance of the points, in step lengths. Points at a larger distance underestimate the error of this step.
    constexpr double max_spacing = 1.2;
    const auto& next = history_points_.next_point();
    const double h = next.t - history_points_[0].t;
    if (history_points_.count() == 1) {
        for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = (next.q[n] - history_points_[0].q[n]) / h - rate_[n];
        return worst_error();
    }
    const int points = std::min(order + 1, history_points_.count());
    history_points_.combine(history_points_.value_weights(next.t, points), points, &TimePoint::q, error_);
    double scale = 1 / (next.t - history_points_[points - 1].t);
    if (plan_.all_reported) scale = std::max(scale, 1 / (max_spacing * points * h));
    if (uses_trapezoidal() && points == 3) scale *= h / (next.t - history_points_[1].t);
    for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = (next.q[n] - error_[n]) * scale;
    return worst_error();
}

}  // namespace corpuscle::circuit
