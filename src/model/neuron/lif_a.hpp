#pragma once

#include "model/current.hpp"
#include "model/neuron/threshold_crossing.hpp"
#include "signal/afferent.hpp"
#include "signal/parameter.hpp"

namespace corpuscle {

/// LIF-A, the leaky integrate-and-fire neuron with a resistor, integrated exactly for a straight-line current:
///     R_m C_m du/dt = -(u - E_L) + R_m I;   u > V_th  =>  spike, then u = V_reset for t_ref
/// (thesis eq. 5, Alg. 3.) Backward Euler is the published algorithm, u[n] = k_a I[n] + k_b u[n-1] + k_c, with constants as in the errata:
/// k_a = R/(1 + RC/T), k_b = (RC/T)/(1 + RC/T), k_c = E_L/(1 + RC/T). A spike then subtracts V_th - V_reset from u. With t_ref above 0 it
/// sets u to V_reset instead, and the refractory time ends on a sample. Limitation: if u exceeds V_th within a step and is below it again
/// at the end, no spike is detected.
struct LifATraits {
    struct Params {
        double C_m = 500e-9, R_m = 1e6, E_L = 0, V_th = 0.5, V_reset = 0.25, t_ref = 0;
    };
    static constexpr std::string_view name = "lif-a", description = "LIF-A: integrate and fire with a leak resistor";
    static constexpr std::string_view source = "thesis 3.2, eq. 5, Alg. 3";
    static constexpr ParameterDef<Params> fields[] = {
        {"C_m", &Params::C_m, "F", 1e-18, 1, "membrane capacitance (C)", "choice: as lif-b"},
        {"R_m", &Params::R_m, "ohm", 1, 1e18, "membrane resistance (R)", "thesis fig. 16"},
        {"E_L", &Params::E_L, "V", -10, 10, "resting potential (u_rest)", "thesis fig. 16"},
        {"V_th", &Params::V_th, "V", -10, 10, "threshold (theta)", "choice: as lif-b"},
        {"V_reset", &Params::V_reset, "V", -10, 10, "potential after a spike (u_rst)", "choice: as lif-b"},
        {"t_ref", &Params::t_ref, "s", 0, 10, "refractory time", "thesis: none"},
    };
    static constexpr OrderConstraint<Params> order_constraints[] = {
        {"V_reset", &Params::V_reset, "V_th", &Params::V_th},
        {"E_L", &Params::E_L, "V_th", &Params::V_th},
    };
    static constexpr Probe recordables[] = {{"u", "V"}};
};

template <class T>
struct LifA : LifATraits {
    struct State {
        T u, ref_steps;  // membrane; remaining refractory time, in steps
    };

    template <class Values>
    LifA(const Values& value, double dt, Method method)
        : R_m(value(&Params::R_m)), E_L(value(&Params::E_L)), V_th(value(&Params::V_th)), V_reset(value(&Params::V_reset)),
          ref(value(&Params::t_ref) / dt), theta(T(dt) / (R_m * value(&Params::C_m))), decay(num::exp(-theta)), mean(num::exprel(-theta)),
          exact(method == Method::exact) {}

    State start() const { return {E_L, T(0.0)}; }
    void flush_decayed(State& s) const { s.u = snap_to_level(s.u, negligible_voltage, E_L); }
    void record(const State& s, T (&out)[1]) const { out[0] = s.u; }

    /// One sample under current i. Calls fired(mask, offset) for each spike. Returns the lanes where the limit of spikes truncated the
    /// step.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        return exact ? step_exact(s, i, fired) : step_sampled(s, i.to, fired);
    }

private:
    T R_m, E_L, V_th, V_reset, ref, theta, decay, mean;
    bool exact;

    /// u after a fraction h of a step, under a current that begins at i and changes by g per step; e = exp(-theta h), m = exprel(-theta h).
    T after(T u, T i, T g, T h, T e, T m) const { return E_L + (u - E_L) * e + R_m * (i * (theta * h * m) + g * h * (T(1.0) - m)); }
    T after(T u, T i, T g, T h) const { return after(u, i, g, h, num::exp(-theta * h), num::exprel(-theta * h)); }

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
            const T at = i.from + g * x;
            const auto rise = [&](T h) {
                const T v = after(u, at, g, h);
                struct {
                    T v, slope;
                } here{v - V_th, theta * (E_L - v + R_m * (at + g * h))};
                return here;
            };
            x = num::select(over, spike_offset(x + rising_root(rise, T(0.0), T(1.0) - x), x), x);
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

    template <class Fired>
    num::Mask<T> step_sampled(State& s, T i, Fired& fired) const {
        const auto refractory = s.ref_steps > T(0.0);
        s.ref_steps = num::positive_part(s.ref_steps - T(1.0));
        const T before = s.u, end = num::select(refractory, before, (before + theta * (E_L + R_m * i)) / (T(1.0) + theta));
        const T drop = V_th - V_reset;
        T level = V_th;  // for the next spike, on the straight line from `before` to `end` without resets
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
