#pragma once
// Plain data only: files that are compiled once for each instruction set include this header and must not define shared inline functions.

namespace corpuscle::circuit {

/// Constants of the transistor's equations (uicm.hpp), computed once for each transistor. per_n is 1 / n, etc.
struct UicmConstants {
    double polarity;                              // 1: NMOS, -1: PMOS
    double V_T, per_n, per_phi_t, sigma_n, zeta;  // V, -, 1/V, -, -; sigma_n is sigma / n
    double I_S, lambda, knee;                     // A, 1/V, V
    double body_w, body_w_phi, per_a, phi;        // V^0.5, V^0.5, -, V: arguments of pinch_off(); body_w = 0: n is constant
    double Q_0, C_dep, C_gs, C_gd, C_gb;          // Q_0 = n phi_t C_ox W L, C; C_dep = (n - 1)/n C_ox W L, F; overlaps, F
    double I_sat_s, I_sat_d, exp_limit_s, exp_limit_d, C_js, C_jd;  // arguments of junction(), for source and drain
    double per_n_phi_t, per_P_B, v_limit, charge_exponent, P_B_per_charge_exponent, per_P_B_M_J;  // of JunctionConstants
    double thermal, flicker;                                                                      // factors in Uicm::noise()
};

}  // namespace corpuscle::circuit
