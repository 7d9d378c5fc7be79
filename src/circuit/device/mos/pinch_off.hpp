#pragma once

#include "circuit/device/uicm_constants.hpp"
#include "core/number/number.hpp"

namespace corpuscle::circuit {

/// Quantities that depend on the gate-bulk voltage alone. _by_G marks derivatives with respect to V_GB.
template <class T>
struct PinchOff {
    T V_P;                    ///< V: pinch-off voltage without DIBL; dV_P/dV_GB = 1/n
    T per_n, per_n_by_G;      ///< 1/n; 1/V
    T n_ratio, n_ratio_by_G;  ///< n relative to n at V_P = 0, to which specific current and channel charge are proportional; 1/V
    T Q_dep, C_dep;           ///< C, F: gate charge that belongs to the depletion charge without inversion, and its derivative
};

/// The body effect: a slope factor n that falls as V_GB rises, because the depletion layer widens.
///
///     n = a + gamma / (2 sqrt(phi + V_P)),   a = n_0 - gamma / (2 sqrt(phi))
///
/// gamma is the body factor (V^0.5), phi the surface potential at threshold (V), n_0 the slope factor at V_P = 0. With a = 1, all of n - 1
/// is the ratio of the depletion layer's capacitance to that of the oxide. Otherwise, a - 1 is this ratio for the interface states. The
/// thesis's eq. 24 is the tangent of V_P at V_P = 0. Integrating n over V_P gives the excess over the threshold,
/// u = V_GB - V_T = a V_P + gamma (sqrt(phi + V_P) - sqrt(phi)), so with w = gamma / (2a)
///
///     r = sqrt((w + sqrt(phi))^2 + u / a),   V_P = (r - w)^2 - phi,   1/n = (r - w) / (a r)
///
/// Below V_P = -15/16 phi, where the channel is empty, n keeps its value and V_P continues as a straight line. Only the derivative of
/// n jumps there.
template <class T>
class BodyEffect {
    T w, w_phi = T(0.0), per_a = T(0.0), phi = T(0.0);  // w_phi = w + sqrt(phi)

public:
    template <class Values>
    explicit BodyEffect(const Values& value) : w(value(&UicmConstants::body_w)) {
        if (!is_present()) return;
        w_phi = value(&UicmConstants::body_w_phi), per_a = value(&UicmConstants::per_a), phi = value(&UicmConstants::phi);
    }

    /// False if n is constant in all lanes.
    [[gnu::always_inline]] bool is_present() const { return num::any(w > T(0.0)); }

    /// Replaces `p` in the lanes with a body effect. C_ox_WL: capacitance of the gate oxide, F.
    [[gnu::always_inline]] void apply(T u, T C_ox_WL, PinchOff<T>& p) const {
        const T one(1.0), half(0.5), s_0 = w_phi - w, r_min = T(0.25) * s_0 + w;
        const T r2 = w_phi * w_phi + u * per_a, r2_min = r_min * r_min;
        const auto is_inside = r2 > r2_min;
        const T r = num::sqrt(num::max(r2, r2_min)), s = r - w, per = one / (r * s), per_r = per * s, per_s = per * r;
        const T per_n = per_a * (s * per_r);
        const T per_n_by_G = num::select(is_inside, half * per_a * per_a * w * (per_r * per_r * per_r), T(0.0));
        const T V_P = s * s - phi + num::min(r2 - r2_min, T(0.0)) * (s * per_r);
        // n_ratio = (r / s) (s_0 / w_phi), since n = a r / s
        const T n_ratio = r * per_s * (s_0 / w_phi), n_ratio_by_G = -(per_n_by_G * n_ratio / per_n);

        const auto has_effect = w > T(0.0);
        const auto replace = [has_effect](T& old, T by) { old = num::select(has_effect, by, old); };
        replace(p.V_P, V_P), replace(p.per_n, per_n), replace(p.per_n_by_G, per_n_by_G);
        replace(p.n_ratio, n_ratio), replace(p.n_ratio_by_G, n_ratio_by_G);
        replace(p.Q_dep, C_ox_WL * (u - V_P)), replace(p.C_dep, C_ox_WL * (one - per_n));
    }
};

}  // namespace corpuscle::circuit
