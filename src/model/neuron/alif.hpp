#pragma once

#include "model/current.hpp"
#include "model/neuron/irregular_threshold.hpp"
#include "model/neuron/threshold_crossing.hpp"

namespace corpuscle {

/// A leaky integrate-and-fire neuron with an adaptive threshold theta:
///
///     R_m C_m du/dt = -(u - E_L) + R_m I;   theta = (V_th + a) (1 + jitter n),  tau_th da/dt = -a
///     u > theta  =>  spike, then u = V_reset for t_ref, a = a + dV_th, and n is drawn anew
///
/// n is a random number with mean 0 and deviation 1, and 0 before the first spike. The adaptive threshold makes the neuron relatively
/// refractory: it follows a vibration with one spike a cycle over a range of amplitudes. The equations are integrated exactly for a
/// straight-line current, with both methods. Limitation: if u exceeds theta within a step and is below it again at the end, no spike is
/// detected.
struct AlifTraits {
    static constexpr std::string_view name = "alif", description = "leaky integrate and fire, with a threshold that rises at each spike";
    static constexpr std::string_view source = "leaky integrate and fire as thesis eq. 5; defaults are fa1-nerve's (doc/nerve-data.md)";
    static constexpr ParameterInfo parameters[] = {
        {"C_m", "F", 4.58e-9, 1e-18, 1, "membrane capacitance"},
        {"R_m", "ohm", 500e3, 1, 1e18, "membrane resistance"},
        {"E_L", "V", 0, -10, 10, "resting potential"},
        {"V_th", "V", 0.5, -10, 10, "threshold at rest"},
        {"V_reset", "V", -0.014, -10, 10, "potential after a spike"},
        {"dV_th", "V", 2.32, 0, 100, "rise of the threshold at a spike"},
        {"tau_th", "s", 13.9e-3, 1e-6, 1e3, "time constant of the threshold's decay"},
        {"t_ref", "s", 1e-3, 0, 10, "refractory time", "nerves: 1 to 2 ms, from memory"},
        {jitter_name, "", 0, 0, 0.33, "standard deviation of the threshold, drawn at each spike, relative to its mean"},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"V_reset", "V_th"},
        {"E_L", "V_th"},
    };
    static constexpr Probe recordables[] = {{"u", "V"}, {"theta", "V"}};
};

template <class T>
struct Alif : AlifTraits {
    struct State {
        T u, a, ref_steps;  // membrane potential, V; rise of the threshold, V; remaining refractory time, in steps
        IrregularThreshold<T> random;
    };

    template <class Values>
    Alif(const Values& value, double dt, Method)
        : R_m(value("R_m")), E_L(value("E_L")), V_th(value("V_th")), V_reset(value("V_reset")), dV_th(value("dV_th")),
          ref(value("t_ref") / dt), jitter(value("jitter")), dt_by_tau(T(dt) / (R_m * value("C_m"))), decay(num::exp(-dt_by_tau)),
          mean(num::exprel(-dt_by_tau)), charge(dt_by_tau * mean), lag(T(1.0) - mean), fall(T(dt) / value("tau_th")),
          threshold_decay(num::exp(-fall)) {}

    /// `stream` in [0, 1) selects the random numbers of an afferent.
    State start(T stream = T(0.0)) const { return {E_L, T(0.0), T(0.0), IrregularThreshold<T>::start(stream)}; }
    void flush_decayed(State& s) const { s.u = snap_to_level(s.u, negligible_voltage, E_L), s.a = snap_to_level(s.a, negligible_voltage); }
    void record(const State& s, T (&out)[2]) const { out[0] = s.u, out[1] = (V_th + s.a) * s.random.factor; }

    /// The values of the state that change in a step without spike and refractory time. All others stay.
    static constexpr T State::*quiet_values[] = {&State::u, &State::a};

    /// Computes `next`, the state after a step in which nothing happens: no spike and no refractory time. Returns the lanes in which one of
    /// these is possible, for which `next` is not valid. `check_refractory`: false if no lane can be refractory.
    template <bool check_refractory, class I>
    [[gnu::always_inline]] num::Mask<T> try_quiet_step(const State& s, const I& current, State& next) const {
        const Current<T> i = current;
        next = {after_step(s.u, i.from, i.to - i.from), s.a * threshold_decay, s.ref_steps, s.random};
        num::Mask<T> events = is_above_threshold(next);
        if (check_refractory) events = events | (s.ref_steps > T(0.0));
        return events;
    }
    bool may_be_refractory() const { return num::any(ref > T(0.0)); }  ///< true if t_ref is above 0 on a lane

    /// Simulates one step under current i. For each spike calls fired(mask, offset): the lanes that fire, and the offset of the spike
    /// within the step. Returns the lanes that reached the limit of spikes in the step. Times within the step are 0 at its beginning and 1
    /// at its end. Time x is the end of the refractory time or the last spike; u and a are the values at x, s.u and s.a those at the end of
    /// the step, as far as spikes have been fired.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        const T g = i.to - i.from;
        T x = num::min(s.ref_steps, T(1.0)), u = s.u, a = s.a;
        s.ref_steps = s.ref_steps - x;
        s.u = after_step(u, i.from, g), s.a = a * threshold_decay;
        const auto was_refractory = x > T(0.0);
        if (num::any(was_refractory)) {
            s.u = num::select(was_refractory, after(u, i.from + g * x, g, T(1.0) - x), s.u);
            a = num::select(was_refractory, a * num::exp(-fall * x), a);
        }
        auto over = is_above_threshold(s);
        for (int pass = 0; num::any(over) && pass < max_spikes_per_step; ++pass) {
            const T at = i.from + g * x;  // current at time x
            // The potential above the threshold at time x + h, and its slope.
            const auto rise = [&](T h) {
                const T v = after(u, at, g, h), above = a * num::exp(-fall * h) * s.random.factor;
                struct {
                    T v, slope;
                } here{v - V_th * s.random.factor - above, dt_by_tau * (E_L - v + R_m * (at + g * h)) + fall * above};
                return here;
            };
            const T spike = spike_offset(x + rising_root(rise, T(0.0), T(1.0) - x, over), x);
            fired(over, spike);
            const T end = spike + ref, from = num::min(end, T(1.0));
            const T risen = a * num::exp(-fall * (spike - x)) + dV_th;  // just after the spike
            s.ref_steps = num::select(over, end - from, s.ref_steps);
            s.a = num::select(over, risen * num::exp(-fall * (T(1.0) - spike)), s.a);
            s.random = draw(s.random, over);
            a = num::select(over, risen * num::exp(-fall * (from - spike)), a);
            u = num::select(over, V_reset, u);
            x = num::select(over, from, x);
            s.u = num::select(over, after(u, i.from + g * x, g, T(1.0) - x), s.u);
            over = over & is_above_threshold(s) & (x < T(1.0));
        }
        return over;
    }

private:
    // ref = t_ref / dt; dt_by_tau = dt / (R_m C_m); decay = exp(-dt_by_tau) and mean = exprel(-dt_by_tau), for a whole step. Also
    // charge = dt_by_tau mean; lag = 1 - mean. The threshold has fall = dt / tau_th; threshold_decay = exp(-fall).
    T R_m, E_L, V_th, V_reset, dV_th, ref, jitter, dt_by_tau, decay, mean, charge, lag, fall, threshold_decay;

    num::Mask<T> is_above_threshold(const State& s) const { return s.u > (V_th + s.a) * s.random.factor; }

    /// The potential after a fraction h of a step, from potential u, under a current that begins at i and changes by g per whole step.
    /// Here exprel(x) = (exp(x) - 1) / x.
    T after(T u, T i, T g, T h) const {
        const T y = -dt_by_tau * h, e = num::exp(y), m = num::exprel(y, e);
        return E_L + (u - E_L) * e + R_m * (i * (dt_by_tau * h * m) + g * h * (T(1.0) - m));
    }
    /// The same for a whole step.
    T after_step(T u, T i, T g) const { return E_L + (u - E_L) * decay + R_m * (i * charge + g * lag); }

    /// The random state after a spike of the lanes of the mask.
    IrregularThreshold<T> draw(const IrregularThreshold<T>& old, num::Mask<T> fired) const {
        const auto n = old.next(jitter);
        return {num::select(fired, n.factor, old.factor), num::select(fired, n.a, old.a), num::select(fired, n.b, old.b),
                num::select(fired, n.c, old.c)};
    }
};

}  // namespace corpuscle
