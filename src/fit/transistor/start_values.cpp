#include "fit/transistor/start_values.hpp"

#include <algorithm>
#include <cmath>

#include "circuit/device/inversion_charge.hpp"
#include "circuit/device/physical_constants.hpp"
#include "core/median.hpp"

namespace corpuscle {
namespace {

using circuit::UicmCard;

double phi_t_at(double celsius) { return circuit::thermal_voltage(celsius + circuit::zero_celsius); }

/// A sweep of V_G as an equivalent NMOS sees it, V_G rising.
struct GateSweep {
    double V_SB, V_DS, temperature;
    std::uint32_t device;
    Vector V_GB, log_I;
};

GateSweep gate_sweep(const IvData& data, const IvCurve& curve) {
    const double polarity = data.is_pmos ? -1 : 1;
    const auto& first = data.points[curve.begin];
    GateSweep out{polarity * (first.v[2] - first.v[3]), polarity * (first.v[0] - first.v[2]), first.temperature, first.device, {}, {}};
    std::vector<std::pair<double, double>> points;
    for (std::size_t k = curve.begin; k < curve.end; ++k) {
        const auto& p = data.points[k];
        if (polarity * p.I_D > 0) points.emplace_back(polarity * (p.v[1] - p.v[3]), num::log(polarity * p.I_D));
    }
    std::sort(points.begin(), points.end());
    // The lowest currents are those of leakage and of noise, if the sweep covers many decades.
    constexpr double decade = 2.302585;
    double low = 1e300, high = -1e300;
    for (const auto& [V, log_I] : points) low = std::min(low, log_I), high = std::max(high, log_I);
    const double least = high - low > 4 * decade ? low + 1.5 * decade : low;
    for (const auto& [V, log_I] : points)
        if (log_I >= least) out.V_GB.push_back(V), out.log_I.push_back(log_I);
    return out;
}

/// g_m/I_D at each point: the slope of a straight line through the points within `width` of it.
Vector slopes_of(const GateSweep& s, double width) {
    Vector out;
    const auto n = s.V_GB.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t from = i, to = i;
        while (from > 0 && (s.V_GB[i] - s.V_GB[from - 1] <= width || i - from < 1)) --from;
        while (to + 1 < n && (s.V_GB[to + 1] - s.V_GB[i] <= width || to - i < 1)) ++to;
        double x = 0, y = 0, xx = 0, xy = 0;
        const double count = static_cast<double>(to - from + 1);
        for (std::size_t k = from; k <= to; ++k) {
            const double V = s.V_GB[k] - s.V_GB[i];
            x += V, y += s.log_I[k], xx += V * V, xy += V * s.log_I[k];
        }
        const double determinant = count * xx - x * x;
        out.push_back(determinant > 0 ? (count * xy - x * y) / determinant : 0);
    }
    return out;
}

/// With the charges q_S = 1 (i_f = 3, V_P = V_S) and q_D: g_m/I_D = 2 / (q_S + q_D + 2) of its maximum, I_D = I_S (3 - q_D (q_D + 2)).
///
/// Returns nullopt if the sweep does not reach from weak inversion to this point.
std::optional<UicmCard> values_of(const GateSweep& s, UicmCard card, double W, double L) {
    const double phi_t = phi_t_at(s.temperature);
    if (s.V_GB.size() < 8 || s.V_DS < phi_t / 10) return std::nullopt;
    const auto slopes = slopes_of(s, 1.2 * phi_t);
    const auto peak = static_cast<std::size_t>(std::max_element(slopes.begin(), slopes.end()) - slopes.begin());
    const double q_D = circuit::inversion_charge(1 - s.V_DS / phi_t), target = slopes[peak] * 2 / (3 + q_D);
    std::size_t k = peak;
    while (k + 1 < slopes.size() && slopes[k + 1] > target) ++k;
    if (k + 1 >= slopes.size() || !(slopes[peak] > 0)) return std::nullopt;
    const double part = std::clamp((slopes[k] - target) / std::max(slopes[k] - slopes[k + 1], 1e-12), 0.0, 1.0);
    const double V = s.V_GB[k] + part * (s.V_GB[k + 1] - s.V_GB[k]), log_I = s.log_I[k] + part * (s.log_I[k + 1] - s.log_I[k]);
    const double T_ratio = (s.temperature + circuit::zero_celsius) / (card.T_nom + circuit::zero_celsius);
    card.n = std::clamp(1 / (phi_t * slopes[peak]), 1.02, 3.0);
    card.V_T0 = V - card.n * s.V_SB - card.alpha_VT * (s.temperature - card.T_nom);
    card.I_SQ = num::exp(log_I - card.I_S_exponent * num::log(T_ratio)) / (3 - q_D * (q_D + 2)) * L / W;
    return card;
}

/// How well the card explains the logarithms of the currents, after its I_SQ has been set to the best value.
double scale_to_data(const IvData& data, const CurveResiduals& residuals, UicmCard& card) {
    std::vector<double> ratios;
    const auto computed = residuals.currents(card);
    for (std::size_t k = 0; k < data.points.size(); ++k)
        if (data.points[k].I_D * computed[k].I_D > 0) ratios.push_back(num::log(data.points[k].I_D / computed[k].I_D));
    if (2 * ratios.size() < data.points.size()) return 1e300;
    const double middle = median_of(ratios);
    card.I_SQ = std::clamp(card.I_SQ * num::exp(middle), 1e-14, 0.9);
    for (auto& r : ratios) r = std::abs(r - middle);
    return median_of(ratios);
}

UicmCard best_of_grid(const IvData& data, const CurveResiduals& residuals, const UicmCard& base) {
    UicmCard best = base;
    double least = 1e301;
    for (int step = -4; step <= 24; ++step) {
        auto card = base;
        card.V_T0 = 0.05 * step, card.n = 1.3;
        if (const double cost = scale_to_data(data, residuals, card); cost < least) least = cost, best = card;
    }
    return best;
}

}  // namespace

UicmCard start_values(const IvData& data, const CurveResiduals& residuals, const UicmCard& base) {
    std::optional<UicmCard> best;
    double least = 1e300;
    for (const auto& curve : data.curves) {
        if (curve.swept != 1 << 1) continue;
        const auto sweep = gate_sweep(data, curve);
        const auto& device = data.devices[sweep.device];
        const auto card = values_of(sweep, base, device.W, device.L);
        if (!card) continue;
        // The recipe is for V_SB = 0, a low V_DS and the nominal temperature.
        const double distance = std::abs(sweep.V_SB) + 0.1 * sweep.V_DS + 0.01 * std::abs(sweep.temperature - base.T_nom);
        if (distance < least) least = distance, best = card;
    }
    return best ? *best : best_of_grid(data, residuals, base);
}

}  // namespace corpuscle
