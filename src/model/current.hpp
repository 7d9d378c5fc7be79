#pragma once
// What passes from a transduction to a neuron, and how time is stepped.

#include <cstdint>

#include "signal/elementary.hpp"

namespace corpuscle {

/// exact: between samples the force is a straight line (first-order hold), filters are integrated exactly under it.
/// backward_euler: the thesis's own algorithms, for its figures.
enum class Method { exact, backward_euler };

/// The current over one step, a straight line between its ends; A.
template <class T>
struct Current {
    T from, to;
    T sum() const { return from + to; }  ///< of its ends: twice its mean
    /// Where it begins below a level and ends above it.
    num::Mask<T> rises_through(T level) const { return (from < level) & (to > level); }
    static constexpr bool may_rise() { return true; }
};

/// A current of one shape for all lanes, times each lane's own gain; the shape's mean is worked out once. V: of one lane.
template <class T, class V, bool rising>
struct Scaled {
    T gain, both;
    V from, to;
    operator Current<T>() const { return {gain * T(from), gain * T(to)}; }
    T sum() const { return gain * both; }
    num::Mask<T> rises_through(T level) const { return Current<T>(*this).rises_through(level); }
    static constexpr bool may_rise() { return rising; }
};

/// High-pass x' + 2 pi f x = K F', under a force that is a straight line in each step.
/// Backward Euler has the same form with other constants: x[n] = k (K (F[n] - F[n-1]) + x[n-1]), k = 1 / (1 + 2 pi f T).
template <class T>
struct HighPass {
    T keep, gain;
    HighPass(T f, double dt, Method method, T K = T(1.0)) {
        const T theta = f * T(6.283185307179586 * dt);
        keep = method == Method::exact ? num::exp(-theta) : T(1.0) / (T(1.0) + theta);
        gain = K * (method == Method::exact ? num::exprel(-theta) : keep);
    }
    T next(T x, T dF) const { return keep * x + gain * dF; }
};

/// After so many samples, counted from the first, a model's settle() lets go of what has faded: so states come to rest where force does,
/// and no numbers are left that are slow because they are tiny.
inline constexpr std::int64_t settling = 1024;
/// What faded so far is nothing: some 1e-16 of what an ulp of its effect would be.
inline constexpr double faded_current = 1e-24, faded_force = 1e-18, faded_voltage = 1e-20;  // A, N, V

/// x, or `level` where they are nearer than `faded`.
template <class T>
T settled(T x, double faded, T level = T(0.0)) {
    return num::select(num::abs(x - level) < T(faded), level, x);
}

/// Hands a model the values of its parameters as T. This one: the same double for every lane.
template <class P>
struct Same {
    const P& p;
    double operator()(double P::* at) const { return p.*at; }
    /// A value that is one for all lanes.
    double one(double P::* at) const { return p.*at; }
};

/// A dual in one chosen parameter: everything derived from it carries the slope.
template <class P>
struct Seeded {
    const P& p;
    double P::* by;
    num::Dual operator()(double P::* at) const { return {p.*at, at == by ? 1.0 : 0.0}; }
    double one(double P::* at) const { return p.*at; }
};

}  // namespace corpuscle
