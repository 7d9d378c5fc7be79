#pragma once

#include "circuit/device/inversion_charge.hpp"

namespace corpuscle::circuit {

/// A quantity of the channel with its derivatives with respect to x_S and x_D, the normalized voltages at source and drain.
template <class T>
struct ValueWithSlopes {
    T value, by_S, by_D;
};

/// The channel between source and drain in normalized form. Units: currents I_S, charges n phi_t C_ox W L. Charges are magnitudes; the
/// caller applies the sign of the carriers.
template <class T>
struct MosChannel {
    T q_S, q_D;                      ///< inversion charge densities at source and drain before velocity saturation
    ValueWithSlopes<T> i, Q_S, Q_D;  ///< current from drain to source; channel charge assigned to the source and to the drain
    /// The charge of the whole channel.
    T Q() const { return Q_S.value + Q_D.value; }
};

/// Unified current control model (thesis app. A) with the velocity saturation of ACM2 (Advanced Compact MOSFET model, version 2). At each
/// end of the channel x = (V_P - V)/phi_t + 1, where V_P is the pinch-off voltage and V the voltage of that end, and
///
///     q + ln q = x;     i = (q_S + q_D + 2)(q_S - q_D) / (1 + zeta |q_S - q_D|)
///
/// zeta is the coefficient of velocity saturation. With h the higher and l the lower of the charges q_S and q_D, l cannot fall below the
/// charge q_sat = zeta i / 2 of carriers at the saturation velocity:
///
///     s = q_sat / h = zeta (h + 2) / (zeta h + 1 + zeta + sqrt((1 + zeta)^2 + 2 zeta h));
///     l' = (q_sat + (1 - 2 s) l) / (1 - s l / h) replaces l
///
/// ACM2 solves a third logarithm for l'. This rational form has the same limits: i = 2 q_sat / zeta in saturation, and i never falls as
/// V_DS grows. It is better at V_DS = 0, where source and drain change places. There the conductance g is that without velocity saturation,
/// so the noise is 4kTg, and the capacitances are continuous. zeta = 0 gives exactly the model without velocity saturation, which has
/// continuous derivatives of all orders. Otherwise current and charges have continuous first derivatives; at V_DS = 0 the second derivative
/// jumps by an amount of order zeta. In saturation i goes to 2 q_S / (1 + zeta) as q_S goes to 0: the saturation velocity limits diffusion,
/// too.
///
/// Charges of ACM2, in a form without cancellation as q goes to 0, with u = q_S + 1 - q_x, w = q_D + 1 - q_x, q_x = zeta i / 2:
///
///     Q_D = (2/15) (2u^3 + 4u^2 w + 6u w^2 + 3w^3) / (u + w)^2 - 1/2 + q_x / 2,   Q_S with u and w exchanged
template <class T>
class OrderedChannel {  // with the end of the higher charge first
    T h, l;
    T zeta;

public:
    struct EndSlopes {
        T high, low;  // derivatives with respect to x at the end with the higher charge and at the other end
    };
    T i, Q_high, Q_low;
    EndSlopes di, dQ_high, dQ_low;

    [[gnu::always_inline]] OrderedChannel(T higher, T lower, T zeta) : h(higher), l(lower), zeta(zeta) {
        const T one(1.0), two(2.0);
        // The lower charge l' (`low`), and delta = h - l'. Divisions are combined: 1 / (x y) gives both 1/x and 1/y. _h and _l mark
        // derivatives with respect to h and l; high_x = dh/dx and low_x = dl/dx, where dq/dx = q / (1 + q).
        const T root = num::sqrt((one + zeta) * (one + zeta) + two * zeta * h), sum = zeta * h + one + zeta + root;
        const T per_root_sum = one / (root * sum);
        const T s = zeta * (h + two) * (per_root_sum * root), hs = one - per_root_sum * sum - s;  // hs = h ds/dh
        const T h1 = one + h, l1 = one + l, per_ends = one / (h * (h1 * l1));
        const T per_h = per_ends * (h1 * l1), r = l * per_h, high_x = h * (h * per_ends * l1), low_x = l * (h * per_ends * h1);
        const T factor = one - s, D = one - s * r, F = D + zeta * factor * (h - l), per_DF = one / (D * F);
        const T per_D = per_DF * F, per_E = per_DF * D * D;  // E = 1 + zeta delta = F / D
        const T t = factor * per_D, remainder = (one - r) * per_D;
        const T low = (h * s + l * (one - two * s)) * per_D, low_l = t * t;
        const T delta = t * (h - l), delta_h = t * (one - r) + r * low_l - remainder * remainder * hs;
        // the current
        i = (h + low + two) * delta * per_E;
        const T drift = (two * (low + one) - zeta * i) * per_E;  // di/d(delta)
        const T i_h = two * delta * per_E + drift * delta_h, i_l = -drift * low_l;
        di = {i_h * high_x, i_l * low_x};
        // the charges, with A = u - 1 and B = w - 1 of the formula above, and X = q_x
        const T half = T(0.5) * zeta, X = half * i, X_h = half * i_h, X_l = half * i_l;
        const T A = h - X, B = low - X;
        const T A_h = one - X_h, A_l = -X_l, B_h = (one - delta_h) - X_h, B_l = low_l - X_l;
        const T per_T = one / (two + A + B), per_T2 = per_T * per_T;
        const EndCharge high_charge(A, B, per_T, per_T2), low_charge(B, A, per_T, per_T2);
        Q_high = high_charge.value + T(0.5) * X;
        Q_low = low_charge.value + T(0.5) * X;
        dQ_high = {(high_charge.own * A_h + high_charge.other * B_h + T(0.5) * X_h) * high_x,
                   (high_charge.own * A_l + high_charge.other * B_l + T(0.5) * X_l) * low_x};
        dQ_low = {(low_charge.own * B_h + low_charge.other * A_h + T(0.5) * X_h) * high_x,
                  (low_charge.own * B_l + low_charge.other * A_l + T(0.5) * X_l) * low_x};
    }

private:
    /// The part of the channel charge assigned to one end, and its derivatives with respect to a (that end) and b (the other end).
    struct EndCharge {
        T value, own, other;
        [[gnu::always_inline]] EndCharge(T a, T b, T per_T, T per_T2) {
            constexpr double c = 2.0 / 15;
            const T aa = a * a, ab = a * b, bb = b * b;
            const T P = T(4.0 / 3) * a + T(2.0 / 3) * b + T(1.5) * aa + T(5.0 / 3) * ab + T(5.0 / 6) * bb +
                        (a * (T(3 * c) * aa + T(6 * c) * ab + T(4 * c) * bb) + b * (T(2 * c) * bb));
            const T P_a = T(4.0 / 3) + T(3.0) * a + T(5.0 / 3) * b + (T(9 * c) * aa + T(12 * c) * ab + T(4 * c) * bb);
            const T P_b = T(2.0 / 3) + T(5.0 / 3) * (a + b) + (T(6 * c) * aa + T(8 * c) * ab + T(6 * c) * bb);
            value = P * per_T2;
            const T less = T(2.0) * value * per_T;
            own = P_a * per_T2 - less;
            other = P_b * per_T2 - less;
        }
    };
};

template <class T>
[[gnu::always_inline]] inline MosChannel<T> evaluate_channel(T x_S, T x_D, T zeta) {
    const T q_S = inversion_charge(x_S), q_D = inversion_charge(x_D);
    const auto forward = q_S >= q_D;
    const OrderedChannel<T> c(num::select(forward, q_S, q_D), num::select(forward, q_D, q_S), zeta);
    const auto pick = [forward](T yes, T no) { return num::select(forward, yes, no); };
    return {q_S,
            q_D,
            {pick(c.i, -c.i), pick(c.di.high, -c.di.low), pick(c.di.low, -c.di.high)},
            {pick(c.Q_high, c.Q_low), pick(c.dQ_high.high, c.dQ_low.low), pick(c.dQ_high.low, c.dQ_low.high)},
            {pick(c.Q_low, c.Q_high), pick(c.dQ_low.high, c.dQ_high.low), pick(c.dQ_low.low, c.dQ_high.high)}};
}

}  // namespace corpuscle::circuit
