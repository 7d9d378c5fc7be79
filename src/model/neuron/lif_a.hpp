#pragma once

#include "model/current.hpp"
#include "model/neuron/threshold_crossing.hpp"

namespace corpuscle {

/// LIF-A, the leaky integrate-and-fire neuron with a resistor, integrated exactly for a straight-line current:
///     R_m C_m du/dt = -(u - E_L) + R_m I;   u > V_th  =>  spike, then u = V_reset for t_ref
/// (thesis eq. 5, Alg. 3.) Backward Euler is the published algorithm, u[n] = k_a I[n] + k_b u[n-1] + k_c. The constants are those of the
/// errata: k_a = R_m/(1 + r), k_b = r/(1 + r), k_c = E_L/(1 + r), where r = R_m C_m/dt. In this method a spike subtracts V_th - V_reset
/// from u. With t_ref above 0 it sets u to V_reset instead, and the refractory time ends on a sample. The thesis writes R, C, theta, u_rst,
/// u_rest. Limitation: if u exceeds V_th within a step and is below it again at the end, no spike is detected.
struct LifATraits {
    static constexpr std::string_view name = "lif-a", description = "LIF-A: integrate and fire with a leak resistor";
    static constexpr std::string_view source = "thesis 3.2, eq. 5, Alg. 3";
    static constexpr ParameterInfo parameters[] = {
        {"C_m", "F", 500e-9, 1e-18, 1, "membrane capacitance (C)", "choice: as lif-b"},
        {"R_m", "ohm", 1e6, 1, 1e18, "membrane resistance (R)", "thesis fig. 16"},
        {"E_L", "V", 0, -10, 10, "resting potential (u_rest)", "thesis fig. 16"},
        {"V_th", "V", 0.5, -10, 10, "threshold (theta)", "choice: as lif-b"},
        {"V_reset", "V", 0.25, -10, 10, "potential after a spike (u_rst)", "choice: as lif-b"},
        {"t_ref", "s", 0, 0, 10, "refractory time", "thesis: none"},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"V_reset", "V_th"},
        {"E_L", "V_th"},
    };
    static constexpr Probe recordables[] = {{"u", "V"}};
};

template <class T>
struct LifA : LifATraits {
    struct State {
        T u, ref_steps;  // membrane potential, V; remaining refractory time, in steps
    };

    template <class Values>
    LifA(const Values& value, double dt, Method method)
        : R_m(value("R_m")), E_L(value("E_L")), V_th(value("V_th")), V_reset(value("V_reset")), ref(value("t_ref") / dt),
          dt_by_tau(T(dt) / (R_m * value("C_m"))), decay(num::exp(-dt_by_tau)), mean(num::exprel(-dt_by_tau)),
          exact(method == Method::exact) {}

    State start() const { return {E_L, T(0.0)}; }
    void flush_decayed(State& s) const { s.u = snap_to_level(s.u, negligible_voltage, E_L); }
    void record(const State& s, T (&out)[1]) const { out[0] = s.u; }

    /// Simulates one step under current i. For each spike calls fired(mask, offset): the lanes that fire, and the offset of the spike
    /// within the step. Returns the lanes that reached the limit of spikes in the step.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        return exact ? step_exact(s, i, fired) : step_sampled(s, i.to, fired);
    }

private:
    // ref = t_ref / dt; dt_by_tau = dt / (R_m C_m); decay = exp(-dt_by_tau) and mean = exprel(-dt_by_tau), for a whole step
    T R_m, E_L, V_th, V_reset, ref, dt_by_tau, decay, mean;
    bool exact;  // true: Method::exact

    /// The potential after a fraction h of a step, from potential u, under a current that begins at i and changes by g per whole step.
    /// The arguments e and m must be exp(-dt_by_tau h) and exprel(-dt_by_tau h). Here exprel(x) = (exp(x) - 1) / x.
    T after(T u, T i, T g, T h, T e, T m) const { return E_L + (u - E_L) * e + R_m * (i * (dt_by_tau * h * m) + g * h * (T(1.0) - m)); }
    T after(T u, T i, T g, T h) const {
        const T y = -dt_by_tau * h, e = num::exp(y);
        return after(u, i, g, h, e, num::exprel(y, e));
    }

    /// A step of the exact method. Times within the step are 0 at its beginning and 1 at its end. Time x is the end of the refractory time
    /// or the last spike, u the potential at x, and s.u the potential at the end of the step, as far as spikes have been fired.
    template <class Fired>
    num::Mask<T> step_exact(State& s, Current<T> i, Fired& fired) const {
        const T g = i.to - i.from;
        T x = num::min(s.ref_steps, T(1.0)), u = s.u;
        s.ref_steps = s.ref_steps - x;
        s.u = after(u, i.from, g, T(1.0), decay, mean);
        const auto was_refractory = x > T(0.0);
        if (num::any(was_refractory)) s.u = num::select(was_refractory, after(u, i.from + g * x, g, T(1.0) - x), s.u);
        auto over = s.u > V_th;
        for (int pass = 0; num::any(over) && pass < max_spikes_per_step; ++pass) {
            const T at = i.from + g * x;  // current at time x
            // The potential above V_th at time x + h, and its slope.
            const auto rise = [&](T h) {
                const T v = after(u, at, g, h);
                struct {
                    T v, slope;
                } here{v - V_th, dt_by_tau * (E_L - v + R_m * (at + g * h))};
                return here;
            };
            x = num::select(over, spike_offset(x + rising_root(rise, T(0.0), T(1.0) - x, over), x), x);
            fired(over, x);
            const T end = x + ref, from = num::min(end, T(1.0));
            s.ref_steps = num::select(over, end - from, s.ref_steps);
            x = num::select(over, from, x);
            u = num::select(over, V_reset, u);
            s.u = num::select(over, after(u, i.from + g * x, g, T(1.0) - x), s.u);
            over = over & (s.u > V_th);
        }
        return over;
    }

    /// A step of backward Euler under the current at its end.
    template <class Fired>
    num::Mask<T> step_sampled(State& s, T i, Fired& fired) const {
        const auto refractory = s.ref_steps > T(0.0);
        s.ref_steps = num::positive_part(s.ref_steps - T(1.0));
        const T before = s.u, end = num::select(refractory, before, (before + dt_by_tau * (E_L + R_m * i)) / (T(1.0) + dt_by_tau));
        const T drop = V_th - V_reset;
        T level = V_th;  // The next spike is where the straight line from `before` to `end`, without resets, reaches this potential.
        s.u = end;
        auto over = s.u > V_th;
        for (int pass = 0; num::any(over) && pass < max_spikes_per_step; ++pass) {
            const T x = spike_offset((level - before) / num::select(over, end - before, T(1.0)), T(0.0));
            fired(over, x);
            s.u = num::select(over, num::select(ref > T(0.0), V_reset, s.u - drop), s.u);
            s.ref_steps = num::select(over, num::positive_part(x + ref - T(1.0)), s.ref_steps);
            level = level + drop;
            over = over & (s.u > V_th);
        }
        return over;
    }
};

}  // namespace corpuscle
