#pragma once
// Integration of neurons without a closed form. Their state is a membrane potential v and a recovery w. It is advanced in equal substeps by
// the classical Runge-Kutta method; the current is a straight line over the step. If v exceeds V_peak in a substep, the crossing is found
// by linear interpolation. v and w are reset there, and the remaining time of the substep is integrated in one more Runge-Kutta step.

#include "model/current.hpp"
#include "model/neuron/threshold_crossing.hpp"

namespace corpuscle {

template <class T>
struct MembraneRecovery {
    T v, w;
    friend MembraneRecovery operator+(MembraneRecovery a, MembraneRecovery b) { return {a.v + b.v, a.w + b.w}; }
    friend MembraneRecovery operator*(T s, MembraneRecovery a) { return {s * a.v, s * a.w}; }
};

/// One Runge-Kutta step of length h (s) from state y. slopes(y, current) returns dy/dt. The current changes from i to i + g during the
/// step.
template <class T, class Slopes>
MembraneRecovery<T> runge_kutta_step(const Slopes& slopes, MembraneRecovery<T> y, T i, T g, T h) {
    const T half = T(0.5) * h, middle = i + T(0.5) * g;
    const auto k1 = slopes(y, i), k2 = slopes(y + half * k1, middle), k3 = slopes(y + half * k2, middle), k4 = slopes(y + h * k3, i + g);
    return y + (h * T(1.0 / 6)) * (k1 + T(2.0) * (k2 + k3) + k4);
}

/// The number of equal substeps in a step of dt, so that none is longer than max_substep (both in s); at most a million.
inline int substep_count(double dt, double max_substep) {
    const double n = dt / max_substep;
    return n <= 1 ? 1 : n > 1e6 ? 1'000'000 : static_cast<int>(n) + (static_cast<int>(n) < n);
}

/// Advances y by one step of dt (s) in `count` substeps. jump(y) returns the state after a spike; fired(mask, offset) is called for each
/// spike with the lanes that fire and the offset within the step.
template <class T, class Slopes, class Jump, class Fired>
void advance_substeps(MembraneRecovery<T>& y, Current<T> i, double dt, int count, T V_peak, const Slopes& slopes, const Jump& jump,
                      Fired& fired) {
    const T h = T(dt / count), g = (i.to - i.from) * T(1.0 / count);
    for (int k = 0; k < count; ++k) {
        const T at = i.from + g * T(static_cast<double>(k));  // current at the beginning of substep k; it changes by g per substep
        const MembraneRecovery<T> before = y;
        y = runge_kutta_step(slopes, before, at, g, h);
        const auto over = y.v > V_peak;
        if (!num::any(over)) continue;
        const T x = spike_offset((V_peak - before.v) / num::select(over, y.v - before.v, T(1.0)), T(0.0)), left = T(1.0) - x;
        fired(over, (T(static_cast<double>(k)) + x) * T(1.0 / count));
        const MembraneRecovery<T> after = jump(MembraneRecovery<T>{V_peak, before.w + x * (y.w - before.w)});
        const MembraneRecovery<T> end = runge_kutta_step(slopes, after, at + g * x, g * left, h * left);
        y.v = num::select(over, num::min(end.v, V_peak), y.v);  // at most one spike per substep
        y.w = num::select(over, end.w, y.w);
    }
}

}  // namespace corpuscle
