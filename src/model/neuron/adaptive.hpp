#pragma once

#include "model/current.hpp"
#include "model/neuron/threshold_crossing.hpp"

namespace corpuscle {

/// A neuron without leak, with a threshold theta that jumps at each spike and decays:
///
///     C_m du/dt = I, but u is never below E_L;   theta = V_th + a,  tau_th da/dt = -a
///     u > theta while I > 0  =>  spike, then u = V_reset for t_ref and a = a + dV_th
///
/// (If the threshold decays below a constant membrane potential, no spike is fired. Without a leak, such a spike would respond to a touch
/// long past.) After Lee et al. 2016 as described in the thesis (3.1: no leak, "an adaptive threshold potential"). The thesis gives no
/// equation and no value, so the equations above and all defaults are our choice. Method has no effect: the equations are integrated
/// exactly for the receptor's current.
struct AdaptiveTraits {
    static constexpr std::string_view name = "adaptive", description = "no leak, and a threshold that rises with each spike and decays";
    static constexpr std::string_view source = "choice, after Lee et al. 2016 as described in thesis 3.1";
    static constexpr ParameterInfo parameters[] = {
        {"C_m", "F", 500e-9, 1e-18, 1, "membrane capacitance"},
        {"E_L", "V", 0, -10, 10, "resting potential, the lower limit of u"},
        {"V_th", "V", 0.5, -10, 10, "threshold at rest"},
        {"V_reset", "V", 0.25, -10, 10, "potential after a spike"},
        {"dV_th", "V", 0.1, 0, 10, "rise of the threshold at a spike"},
        {"tau_th", "s", 50e-3, 1e-6, 1e3, "time constant of the threshold's decay"},
        {"t_ref", "s", 0, 0, 10, "refractory time"},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"V_reset", "V_th"},
        {"E_L", "V_reset", true},
    };
    static constexpr Probe recordables[] = {{"u", "V"}, {"theta", "V"}};
};

template <class T>
struct Adaptive : AdaptiveTraits {
    struct State {
        T u, a, ref_steps;  // membrane potential, V; threshold minus V_th, V; remaining refractory time, in steps
    };

    template <class Values>
    Adaptive(const Values& value, double dt, Method)
        : k(T(dt) / value("C_m")), E_L(value("E_L")), V_th(value("V_th")), V_reset(value("V_reset")), dV_th(value("dV_th")),
          ref(value("t_ref") / dt), fall(T(dt) / value("tau_th")), decay(num::exp(-fall)) {}

    State start() const { return {E_L, T(0.0), T(0.0)}; }
    void record(const State& s, T (&out)[2]) const { out[0] = s.u, out[1] = V_th + s.a; }

    /// Simulates one step under current i. For each spike calls fired(mask, offset): the lanes that fire, and the offset of the spike
    /// within the step. Returns the lanes that reached the limit of spikes in the step. Times within the step are 0 at its beginning and 1
    /// at its end. Time x is the end of the refractory time or, without one, the last spike (0 before the first); s.u and s.a are always
    /// the values at the end of the step, as far as spikes have been fired.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        T x = num::min(s.ref_steps, T(1.0)), a = s.a;  // a: threshold minus V_th at time x
        s.ref_steps = s.ref_steps - x;
        const auto was_refractory = x > T(0.0);
        if (num::any(was_refractory)) a = num::select(was_refractory, a * num::exp(-fall * x), a);
        const Parabola<T> rise{i.from * k, (i.to - i.from) * k};
        T base = num::max(s.u - rise.at(x), E_L - rise.min_from(x));  // from x on, u(y) = base + rise.at(y)
        s.u = base + rise.at(T(1.0));
        s.a = a * decay;
        if (num::any(was_refractory)) s.a = num::select(was_refractory, a * num::exp(-fall * (T(1.0) - x)), s.a);
        // The interval [first, last] in which the current is positive: the whole step, or the part before or after its zero crossing.
        const num::Mask<T> starts = i.from > T(0.0), ends = i.to > T(0.0), changes_sign = starts ^ ends;
        const T zero_crossing = num::select(changes_sign, i.from / num::select(changes_sign, i.from - i.to, T(1.0)), T(0.0));
        const T first = num::select(starts, T(0.0), num::select(ends, zero_crossing, T(1.0))),
                last = num::select(ends, T(1.0), zero_crossing);
        // The threshold minus V_th at time y, if no spike is fired between x and y.
        const auto excess = [&](T y) { return a * num::exp(-fall * (y - x)); };
        // The lanes in which u is above the threshold at time `last`, and `last` is after x.
        const auto is_above_threshold = [&] {
            T height = s.u - s.a;  // u - a at time `last`, to be compared with V_th
            if (num::any(changes_sign)) height = num::select(changes_sign & starts, base + rise.at(last) - excess(last), height);
            return (height > V_th) & (starts | ends) & (last > x);
        };
        num::Mask<T> over = is_above_threshold();
        for (int pass = 0; num::any(over) && pass < max_spikes_per_step; ++pass) {
            // u minus the threshold at time y, and its slope.
            const auto margin = [&](T y) {
                const T above = excess(y);
                struct {
                    T v, slope;
                } here{base + rise.at(y) - V_th - above, rise.a + rise.b * y + fall * above};
                return here;
            };
            const T at = spike_offset(rising_root(margin, num::max(x, first), last, over), num::max(x, first));
            fired(over, at);
            // Ends of the refractory time, and of the part of it that is within the step.
            const T end = at + ref, from = num::min(end, T(1.0));
            s.ref_steps = num::select(over, end - from, s.ref_steps);
            base = num::select(over, V_reset - rise.at(from), base);
            a = num::select(over, (a * num::exp(-fall * (at - x)) + dV_th) * num::exp(-fall * (from - at)), a);
            x = num::select(over, from, x);
            s.u = num::select(over, num::max(base + rise.at(T(1.0)), E_L), s.u);
            s.a = num::select(over, a * num::exp(-fall * (T(1.0) - x)), s.a);
            over = over & is_above_threshold();
        }
        return over;
    }

private:
    T k, E_L, V_th, V_reset, dV_th, ref, fall, decay;  // k = dt / C_m, ref = t_ref / dt, fall = dt / tau_th, decay = exp(-fall)
};

}  // namespace corpuscle
