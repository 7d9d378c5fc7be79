#pragma once

#include "circuit/device/inversion_charge.hpp"

namespace corpuscle::circuit {

/// Constants common to all junctions of one model card at one temperature: thermal voltage phi_t = kT/q, ideality factor n_dio, built-in
/// potential P_B (V), grading coefficient M_J. Above v_limit = F_C P_B, with 0 <= F_C < 1, the capacitance is extrapolated linearly.
template <class T>
struct JunctionConstants {
    T per_n_phi_t;                                            ///< 1 / (n_dio phi_t), 1/V
    T per_P_B, v_limit;                                       ///< 1 / P_B, F_C P_B
    T charge_exponent, P_B_per_charge_exponent, per_P_B_M_J;  ///< 1 - M_J, P_B / (1 - M_J), M_J / P_B
};

template <class T>
struct JunctionEvaluation {
    T i, g, q, c;  ///< current (A), di/dv (S), charge (C), dq/dv (F)
};

/// Junction diode, v = v_anode - v_cathode.   i = I_sat (exp(v / (n_dio phi_t)) - 1)   (thesis eq. 43);
///     q = C_0 P_B / (1 - M_J) (1 - (1 - v / P_B)^(1 - M_J)),   c = dq/dv = C_0 / (1 - v / P_B)^M_J
/// The current is extrapolated linearly where v / (n_dio phi_t) exceeds `exp_limit`, the value at which the current is
/// junction_current_limit (uicm_card.hpp). Current and capacitance are continuous with their derivatives at the start of the extrapolation;
/// that of the capacitance is SPICE's. No breakdown, series resistance or transit time. I_sat: saturation current, A; C_0: capacitance at
/// 0 V, F.
template <class T>
[[gnu::always_inline]] inline JunctionEvaluation<T> junction(T v, T I_sat, T exp_limit, T C_0, const JunctionConstants<T>& constants) {
    const T x = v * constants.per_n_phi_t, x_e = num::min(x, exp_limit), e = I_sat * num::exp(x_e);

    const T v_c = num::min(v, constants.v_limit), dv = v - v_c;
    const T t = T(1.0) - v_c * constants.per_P_B, per_t = T(1.0) / t, y = num::exp(constants.charge_exponent * fast_log(t));
    const T c = C_0 * y * per_t, c_v = c * constants.per_P_B_M_J * per_t;
    const T q = C_0 * constants.P_B_per_charge_exponent * (T(1.0) - y);

    return {e * (T(1.0) + (x - x_e)) - I_sat, e * constants.per_n_phi_t, q + dv * (c + T(0.5) * c_v * dv), c + c_v * dv};
}

}  // namespace corpuscle::circuit
