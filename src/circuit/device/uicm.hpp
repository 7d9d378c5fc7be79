#pragma once

#include "circuit/device/mos/pinch_off.hpp"
#include "circuit/device/mos_channel.hpp"
#include "circuit/device/uicm_constants.hpp"

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

/// The order of the terminals in an M line and in all arrays below.
struct Terminals {
    enum { D, G, S, B };
};

/// Currents from the nodes into the device (A), without displacement currents, and charges of the terminals (C): at drain, gate, source,
/// bulk. di[a][b] is the derivative of i[a] with respect to the voltage of terminal b; dq likewise.
template <class T>
struct UicmEvaluation : Terminals {
    T i[4], q[4], di[4][4], dq[4][4];
};

/// Noise power densities, A^2/Hz: thermal and flicker noise of the channel between drain and source, shot noise of the two junctions.
/// Flicker noise is proportional to 1/f; this is its value at 1 Hz.
template <class T>
struct UicmNoise {
    T thermal, flicker, shot_s, shot_d;
};

/// Internal quantities of a transistor, for the polarity of an NMOS.
template <class T>
struct UicmInternals {
    T q_S, q_D;     ///< normalized inversion charge densities at source and drain; i_f = q_S (q_S + 2), i_r = q_D (q_D + 2)
    T I, I_s, I_d;  ///< A: channel current, drain to source; junction currents, bulk to source and bulk to drain
};

/// MOS transistor: unified current control model (thesis app. A; equations and the parts from ACM2 are in mos_channel.hpp).
///
///     V_P = (V_GB - V_T + sigma (V_DB + V_SB)) / n;     x_S(D) = (V_P - V_S(D)B) / phi_t + 1
///
///     I_D = I_S i(x_S, x_D) (1 + (sqrt(V_DS^2 + knee^2) - knee) / V_A),   knee = 4 phi_t, V_A = V_E L
///
/// V_P is the pinch-off voltage, n the slope factor, sigma the coefficient of DIBL. I_S is the specific current, i(x_S, x_D) the normalized
/// current, V_A the Early voltage. n is constant, or a function of V_GB (pinch_off.hpp); I_S is proportional to it. Well above the knee,
/// the voltage at which I_D saturates in weak inversion, the output conductance is I_D / V_A. The factor in brackets is 1 at V_DS = 0 and
/// even in V_DS, so exchanging source and drain negates I_D to the last bit.
///
/// Charges:
///
/// - Q_S and Q_D, the parts of the channel charge Q_I = Q_S + Q_D that belong to source and drain
/// - Q_B = -(n - 1)/n Q_I - C_ox W L (V_GB - V_T - V_P), with V_P without DIBL: the depletion charge that n implies. With a constant n, the
///   second term is (n - 1)/n C_ox W L V_GB and a constant, which is left out. ACM2 has this term in the capacitances but not in the
///   charges.
/// - Q_G = -(Q_S + Q_D + Q_B)
/// - overlaps, and junctions
///
/// Noise power densities, with the mobility mu, the effective trap density N_ot, the electron charge q and the normalized charge densities
/// q_S and q_D:
///
/// - thermal 4kT mu |Q_I| / L^2
/// - flicker q^2 N_ot mu I_D / (L^2 n C_ox) ln((1 + q_S) / (1 + q_D)) / f
/// - shot 2q (I + 2 I_sat) of each junction
///
/// Temperature: V_T is linear in T, I_S is proportional to a power of T; phi_t and the saturation current of the junctions vary, too. n,
/// sigma, zeta, V_E and the capacitances are constant. Left out: gate leakage, impact ionisation, gate-induced drain leakage, accumulation,
/// non-quasi-static effects, self-heating, series resistance.
template <class T>
class Uicm : public Terminals {
    T polarity, V_T, per_n, per_phi_t, sigma_n, zeta, I_S, lambda, knee, Q_0, C_dep, C_gs, C_gd, C_gb;
    T I_sat_s, I_sat_d, exp_limit_s, exp_limit_d, C_js, C_jd, thermal, flicker;
    JunctionConstants<T> junction_constants;
    BodyEffect<T> body_effect;

public:
    /// value(&UicmConstants::x) must return the constant x, which may differ between lanes.
    template <class Values>
    explicit Uicm(const Values& value)
        : polarity(value(&UicmConstants::polarity)), V_T(value(&UicmConstants::V_T)), per_n(value(&UicmConstants::per_n)),
          per_phi_t(value(&UicmConstants::per_phi_t)), sigma_n(value(&UicmConstants::sigma_n)), zeta(value(&UicmConstants::zeta)),
          I_S(value(&UicmConstants::I_S)), lambda(value(&UicmConstants::lambda)), knee(value(&UicmConstants::knee)),
          Q_0(value(&UicmConstants::Q_0)), C_dep(value(&UicmConstants::C_dep)), C_gs(value(&UicmConstants::C_gs)),
          C_gd(value(&UicmConstants::C_gd)), C_gb(value(&UicmConstants::C_gb)), I_sat_s(value(&UicmConstants::I_sat_s)),
          I_sat_d(value(&UicmConstants::I_sat_d)), exp_limit_s(value(&UicmConstants::exp_limit_s)),
          exp_limit_d(value(&UicmConstants::exp_limit_d)), C_js(value(&UicmConstants::C_js)), C_jd(value(&UicmConstants::C_jd)),
          thermal(value(&UicmConstants::thermal)), flicker(value(&UicmConstants::flicker)),
          junction_constants{value(&UicmConstants::per_n_phi_t),
                             value(&UicmConstants::per_P_B),
                             value(&UicmConstants::v_limit),
                             value(&UicmConstants::charge_exponent),
                             value(&UicmConstants::P_B_per_charge_exponent),
                             value(&UicmConstants::per_P_B_M_J)},
          body_effect(value) {}

    /// One transistor, or the same in all lanes.
    explicit Uicm(const UicmConstants& c) : Uicm([&c](double UicmConstants::* member) { return T(c.*member); }) {}

    /// Evaluates currents, charges and derivatives at the voltages of drain, gate, source and bulk. Inlined so that the compiler removes
    /// derivatives that are not used.
    [[gnu::always_inline]] void eval(const T (&v)[4], UicmEvaluation<T>& out) const {
        const Voltages at(v, polarity);
        const PinchOff<T> p = pinch_off(at.gb);
        const MosChannel<T> c = channel(at, p);
        const T early = num::sqrt(at.ds * at.ds + knee * knee), factor = I_S * (T(1.0) + lambda * (early - knee));
        const auto b_s = junction(-at.sb, I_sat_s, exp_limit_s, C_js, junction_constants),
                   b_d = junction(-at.db, I_sat_d, exp_limit_d, C_jd, junction_constants);
        currents(p, c.i, factor, I_S * p.n_ratio * c.i.value * lambda * (at.ds / early), b_s, b_d, out);
        charges(at, p, c, b_s, b_d, out);
    }

    UicmNoise<T> noise(const T (&v)[4]) const {
        const Voltages at(v, polarity);
        const PinchOff<T> p = pinch_off(at.gb);
        const MosChannel<T> c = channel(at, p);
        const auto b_s = junction(-at.sb, I_sat_s, exp_limit_s, C_js, junction_constants),
                   b_d = junction(-at.db, I_sat_d, exp_limit_d, C_jd, junction_constants);
        // The factor is 2q.
        const auto shot = [](const T& i, const T& I_sat) { return T(2 * 1.602176634e-19) * num::abs(i + T(2.0) * I_sat); };
        const T log_ratio = num::abs(num::log((T(1.0) + c.q_S) / (T(1.0) + c.q_D)));
        return {thermal * p.n_ratio * c.Q(), flicker * I_S * num::abs(c.i.value) * log_ratio, shot(b_s.i, I_sat_s), shot(b_d.i, I_sat_d)};
    }

    UicmInternals<T> internals(const T (&v)[4]) const {
        const Voltages at(v, polarity);
        const PinchOff<T> p = pinch_off(at.gb);
        const MosChannel<T> c = channel(at, p);
        const T early = num::sqrt(at.ds * at.ds + knee * knee);
        return {c.q_S, c.q_D, I_S * p.n_ratio * (T(1.0) + lambda * (early - knee)) * c.i.value,
                junction(-at.sb, I_sat_s, exp_limit_s, C_js, junction_constants).i,
                junction(-at.db, I_sat_d, exp_limit_d, C_jd, junction_constants).i};
    }

private:
    /// Terminal voltages relative to the bulk, for the polarity of an NMOS.
    struct Voltages {
        T gb, sb, db, ds;
        Voltages(const T (&v)[4], T polarity)
            : gb(polarity * (v[G] - v[B])), sb(polarity * (v[S] - v[B])), db(polarity * (v[D] - v[B])), ds(polarity * (v[D] - v[S])) {}
    };

    [[gnu::always_inline]] PinchOff<T> pinch_off(T gb) const {
        PinchOff<T> p{(gb - V_T) * per_n, per_n, T(0.0), T(1.0), T(0.0), C_dep * gb, C_dep};
        if (body_effect.is_present()) body_effect.apply(gb - V_T, Q_0 * per_phi_t * per_n, p);
        return p;
    }

    [[gnu::always_inline]] MosChannel<T> channel(const Voltages& at, const PinchOff<T>& p) const {
        const T V_P = p.V_P + sigma_n * (at.db + at.sb);
        return evaluate_channel((V_P - at.sb) * per_phi_t + T(1.0), (V_P - at.db) * per_phi_t + T(1.0), zeta);
    }

    /// Derivatives of a quantity with respect to the four terminal voltages. They sum to zero.
    struct Slopes {
        T d, g, s, b;
    };
    /// From the derivatives with respect to x_S and x_D, and with respect to V_GB at constant x.
    [[gnu::always_inline]] Slopes by_voltages(const PinchOff<T>& p, T by_S, T by_D, T by_G) const {
        const T all = (by_S + by_D) * per_phi_t;
        const T d = all * sigma_n - by_D * per_phi_t, g = all * p.per_n + by_G, s = all * sigma_n - by_S * per_phi_t;
        return {d, g, s, -(d + g + s)};
    }

    /// `factor`: I_S at the pinch-off voltage 0, times the factor of the Early effect. `early_d`: the part of dI_D/dV_DS that comes from
    /// the Early effect. `b_s`, `b_d`: the junctions from bulk to source and to drain.
    [[gnu::always_inline]] void currents(const PinchOff<T>& p, const ValueWithSlopes<T>& i, T factor, T early_d,
                                         const JunctionEvaluation<T>& b_s, const JunctionEvaluation<T>& b_d, UicmEvaluation<T>& out) const {
        const T scale = factor * p.n_ratio, I = scale * i.value, zero(0.0);
        const Slopes g = by_voltages(p, scale * i.by_S, scale * i.by_D, factor * i.value * p.n_ratio_by_G);
        const T g_d = g.d + early_d, g_s = g.s - early_d;
        out.i[D] = polarity * (I - b_d.i), out.i[G] = zero, out.i[S] = -polarity * (I + b_s.i);
        out.i[B] = polarity * (b_s.i + b_d.i);
        put(out.di[D], g_d + b_d.g, g.g, g_s, g.b - b_d.g);
        put(out.di[G], zero, zero, zero, zero);
        put(out.di[S], -g_d, -g.g, b_s.g - g_s, -g.b - b_s.g);
        put(out.di[B], -b_d.g, zero, -b_s.g, b_s.g + b_d.g);
    }

    [[gnu::always_inline]] void charges(const Voltages& at, const PinchOff<T>& p, const MosChannel<T>& c, const JunctionEvaluation<T>& b_s,
                                        const JunctionEvaluation<T>& b_d, UicmEvaluation<T>& out) const {
        // o_d, o_s, o_b: overlap charges; o_b includes the depletion charge without inversion.
        const T gd = at.gb - at.db, gs = at.gb - at.sb, o_d = C_gd * gd, o_s = C_gs * gs, o_b = C_gb * at.gb + p.Q_dep;
        const T scale = Q_0 * p.n_ratio, Q_S = -(scale * c.Q_S.value), Q_D = -(scale * c.Q_D.value), Q_I = Q_S + Q_D;
        const T d = Q_D - o_d - b_d.q, s = Q_S - o_s - b_s.q, b = -((T(1.0) - p.per_n) * Q_I) - o_b + b_s.q + b_d.q;
        out.q[D] = polarity * d, out.q[S] = polarity * s, out.q[B] = polarity * b, out.q[G] = -polarity * (d + s + b);

        const T by_G = Q_0 * p.n_ratio_by_G;
        const Slopes d_by = by_voltages(p, -(scale * c.Q_D.by_S), -(scale * c.Q_D.by_D), -(by_G * c.Q_D.value)),
                     s_by = by_voltages(p, -(scale * c.Q_S.by_S), -(scale * c.Q_S.by_D), -(by_G * c.Q_S.value));
        const T factor = p.per_n - T(1.0), C_b = C_gb + p.C_dep - p.per_n_by_G * Q_I;
        const Slopes both{d_by.d + s_by.d, d_by.g + s_by.g, d_by.s + s_by.s, d_by.b + s_by.b};
        put(out.dq[D], d_by.d + C_gd + b_d.c, d_by.g - C_gd, d_by.s, d_by.b - b_d.c);
        put(out.dq[G], -(p.per_n * both.d) - C_gd, C_gd + C_gs + C_b - p.per_n * both.g, -(p.per_n * both.s) - C_gs,
            -(p.per_n * both.b) - C_b);
        put(out.dq[S], s_by.d, s_by.g - C_gs, s_by.s + C_gs + b_s.c, s_by.b - b_s.c);
        put(out.dq[B], factor * both.d - b_d.c, factor * both.g - C_b, factor * both.s - b_s.c, factor * both.b + C_b + b_s.c + b_d.c);
    }

    [[gnu::always_inline]] static void put(T (&row)[4], T d, T g, T s, T b) { row[D] = d, row[G] = g, row[S] = s, row[B] = b; }
};

}  // namespace corpuscle::circuit
