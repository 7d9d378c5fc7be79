#pragma once
// The current from a receptor to a neuron. Also includes what the declaration of every model needs: Probe and ParameterInfo.

#include <cstdint>

#include "core/afferent.hpp"
#include "core/number/elementary.hpp"
#include "core/parameter.hpp"
#include "core/simulation_options.hpp"

namespace corpuscle {

/// The current during one step: a straight line from its value at the beginning of the step to its value at the end, A.
template <class T>
struct Current {
    T from, to;
    T sum() const { return from + to; }  ///< of the values at both ends, which is twice the mean
    /// True on the lanes where the current begins the step below `level` and ends it above `level`.
    num::Mask<T> rises_through(T level) const { return (from < level) & (to > level); }
    static constexpr bool may_rise() { return true; }  ///< false: rises_through() need not be called, because the current does not rise
};

/// A current that is the same on all lanes (`from`, `to`, and their sum `end_sum`), times a gain of each lane. T: number type of all lanes;
/// V: number type of one lane; rising: true if `to` is above `from`.
template <class T, class V, bool rising>
struct ScaledCurrent {
    T gain, end_sum;
    V from, to;
    operator Current<T>() const { return {gain * T(from), gain * T(to)}; }
    T sum() const { return gain * end_sum; }
    num::Mask<T> rises_through(T level) const { return Current<T>(*this).rises_through(level); }
    static constexpr bool may_rise() { return rising; }
};

/// The high-pass x' + 2 pi f x = K F' with cutoff frequency f (Hz), for a force F that is a straight line in each step of dt (s):
///
///     x[n] = decay x[n-1] + gain (F[n] - F[n-1]),   theta = 2 pi f dt
///     exact: decay = exp(-theta), gain = K (1 - decay) / theta;   backward Euler: decay = 1 / (1 + theta), gain = K decay
template <class T>
struct HighPass {
    T decay, gain;
    HighPass(T f, double dt, Method method, T K = T(1.0)) {
        const T theta = f * T(6.283185307179586 * dt);
        decay = method == Method::exact ? num::exp(-theta) : T(1.0) / (T(1.0) + theta);
        gain = K * (method == Method::exact ? num::exprel(-theta) : decay);  // exprel(x) = (exp(x) - 1) / x
    }
    T next(T x, T dF) const { return decay * x + gain * dF; }
};

/// Before every 1,024th sample of a simulation (samples 1,024, 2,048 ..., the first being 0), flush_decayed() sets the state variables of a
/// model that have almost decayed to their resting values. Without force a state then reaches rest exactly. This also avoids denormal
/// numbers, which are slow.
inline constexpr std::int64_t flush_interval = 1024;
/// A state variable has decayed if it is closer to rest than this. The limits are 1e-18 of typical values (1 uA, 1 N, 10 mV), which is less
/// than 1 % of the rounding unit (ulp) of these values.
inline constexpr double negligible_current = 1e-24, negligible_force = 1e-18, negligible_voltage = 1e-20;  // A, N, V

/// `level` where x is closer to it than `tolerance`, otherwise x.
template <class T>
T snap_to_level(T x, double tolerance, T level = T(0.0)) {
    return num::select(num::abs(x - level) < T(tolerance), level, x);
}

}  // namespace corpuscle
