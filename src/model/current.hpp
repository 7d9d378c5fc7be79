#pragma once
// The current from a receptor to a neuron, and the integration methods.

#include <cstdint>

#include "signal/elementary.hpp"

namespace corpuscle {

/// exact: between samples the force is a straight line (first-order hold), and filters are integrated exactly for such a force.
/// backward_euler: the algorithms of the thesis, to reproduce its figures.
enum class Method { exact, backward_euler };

/// The current over one step: a straight line between the values at its ends, A.
template <class T>
struct Current {
    T from, to;
    T sum() const { return from + to; }  ///< of the two ends: twice the mean
    /// True on the lanes where the current begins below a level and ends above it.
    num::Mask<T> rises_through(T level) const { return (from < level) & (to > level); }
    static constexpr bool may_rise() { return true; }
};

/// A current with the same shape on all lanes, times a gain for each lane. The sum of its ends is computed once. V: type of one lane.
template <class T, class V, bool rising>
struct ScaledCurrent {
    T gain, end_sum;
    V from, to;
    operator Current<T>() const { return {gain * T(from), gain * T(to)}; }
    T sum() const { return gain * end_sum; }
    num::Mask<T> rises_through(T level) const { return Current<T>(*this).rises_through(level); }
    static constexpr bool may_rise() { return rising; }
};

/// High-pass x' + 2 pi f x = K F', for a force that is a straight line in each step.
/// Backward Euler has the same form with other constants: x[n] = k (K (F[n] - F[n-1]) + x[n-1]), k = 1 / (1 + 2 pi f T).
template <class T>
struct HighPass {
    T decay, gain;
    HighPass(T f, double dt, Method method, T K = T(1.0)) {
        const T theta = f * T(6.283185307179586 * dt);
        decay = method == Method::exact ? num::exp(-theta) : T(1.0) / (T(1.0) + theta);
        gain = K * (method == Method::exact ? num::exprel(-theta) : decay);
    }
    T next(T x, T dF) const { return decay * x + gain * dF; }
};

/// Every 1,024 samples, counted from the first, a model's flush_decayed() sets decayed state to zero. Without force a state then reaches
/// exact rest. This also avoids denormals, which are slow.
inline constexpr std::int64_t flush_interval = 1024;
/// State below these limits is set to zero. They are 1e-18 of typical values (1 uA, 1 N, 10 mV), which is less than 1 % of an ulp.
inline constexpr double negligible_current = 1e-24, negligible_force = 1e-18, negligible_voltage = 1e-20;  // A, N, V

/// `level` where x is closer to it than `tolerance`, otherwise x.
template <class T>
T snap_to_level(T x, double tolerance, T level = T(0.0)) {
    return num::select(num::abs(x - level) < T(tolerance), level, x);
}

/// Passes the values of a model's parameters to its constructor: here the same double on all lanes.
template <class P>
struct UniformParams {
    const P& p;
    double operator()(double P::* at) const { return p.*at; }
    /// A value that must be the same on all lanes.
    double uniform(double P::* at) const { return p.*at; }
};

/// The parameters as dual numbers with slope 1 in one of them: everything computed from them carries the derivative.
template <class P>
struct DualParams {
    const P& p;
    double P::* variable;
    num::Dual operator()(double P::* at) const { return {p.*at, at == variable ? 1.0 : 0.0}; }
    double uniform(double P::* at) const { return p.*at; }
};

}  // namespace corpuscle
