#pragma once

#include "circuit/device/short_log.hpp"

namespace corpuscle::circuit {

/// What all junctions of one card share at one temperature. Beyond the argument `top` (junction_current_top in A) a current goes on
/// along its tangent; beyond v_top = F_C P_B a charge goes on with a capacitance that rises along its own.
template <class T>
struct JunctionLaw {
    T per_n_phi_t;                      ///< 1 / (n_dio phi_t), 1/V
    T per_P_B, v_top;                   ///< 1 / P_B, F_C P_B
    T rest, P_B_per_rest, per_P_B_M_J;  ///< 1 - M_J, P_B / (1 - M_J), M_J / P_B
};

template <class T>
struct JunctionAnswer {
    T i, g, q, c;
};

/// Junction diode, v = v_anode - v_cathode.   i = I_sat (exp(v / n_dio phi_t) - 1)   (thesis eq. 43);
///     q = C_0 P_B / (1 - M_J) (1 - (1 - v / P_B)^(1 - M_J)),   c = dq/dv = C_0 / (1 - v / P_B)^M_J
/// Both have continuous slopes; the charge's continuation is SPICE's. No breakdown, no series resistance, no transit time.
template <class T>
[[gnu::always_inline]] inline JunctionAnswer<T> junction(T v, T I_sat, T top, T C_0, const JunctionLaw<T>& law) {
    const T x = v * law.per_n_phi_t, x_e = num::min(x, top), e = I_sat * num::exp(x_e);

    const T v_c = num::min(v, law.v_top), dv = v - v_c;
    const T t = T(1.0) - v_c * law.per_P_B, per_t = T(1.0) / t, y = num::exp(law.rest * short_log(t));
    const T c = C_0 * y * per_t, c_v = c * law.per_P_B_M_J * per_t;
    const T q = C_0 * law.P_B_per_rest * (T(1.0) - y);

    return {e * (T(1.0) + (x - x_e)) - I_sat, e * law.per_n_phi_t, q + dv * (c + T(0.5) * c_v * dv), c + c_v * dv};
}

}  // namespace corpuscle::circuit
