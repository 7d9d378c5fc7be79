#pragma once

#include "model/current.hpp"
#include "model/neuron/step.hpp"
#include "signal/afferent.hpp"
#include "signal/field.hpp"

namespace corpuscle {

/// LIF-B, the thesis's leaky integrate-and-fire with a constant leak, integrated exactly under a straight-line current:
///     C_m du/dt = I - I_leak0 above E_L, u held at E_L when I < I_leak0;   u > V_th  =>  spike, then u = V_reset for t_ref
/// (thesis eq. 6, 7, Alg. 4; errata: u[n-1], not u_rest, is what the algorithm adds to. C, theta, u_rst, u_rest there.)
/// A peak of u inside a step that has fallen below V_th again at its end is not seen.
struct LifBFacts {
    struct Params {
        double C_m = 500e-9, I_leak0 = 500e-9, E_L = 0, V_th = 0.5, V_reset = 0.25, t_ref = 0;
    };
    static constexpr std::string_view name = "lif-b", sentence = "LIF-B: integrate and fire with a constant leak current";
    static constexpr std::string_view source = "thesis 3.2, eq. 6, 7, Alg. 4";
    static constexpr Field<Params> fields[] = {
        {"C_m", &Params::C_m, "F", 1e-18, 1, "membrane capacitance (C)", "thesis 3.3"},
        {"I_leak0", &Params::I_leak0, "A", 0, 1, "leak above E_L; the rheobase", "thesis 3.3"},
        {"E_L", &Params::E_L, "V", -10, 10, "resting potential (u_rest)", "thesis fig. 16"},
        {"V_th", &Params::V_th, "V", -10, 10, "threshold (theta)", "choice: the thesis leaves it open"},
        {"V_reset", &Params::V_reset, "V", -10, 10, "potential after a spike (u_rst)", "choice: the thesis leaves it open"},
        {"t_ref", &Params::t_ref, "s", 0, 10, "refractory time", "thesis: none"},
    };
    static constexpr Below<Params> orders[] = {
        {"V_reset", &Params::V_reset, "V_th", &Params::V_th},
        {"E_L", &Params::E_L, "V_reset", &Params::V_reset, true},
    };
    static constexpr Probe parts[] = {{"u", "V"}};
};

template <class T>
struct LifB : LifBFacts {
    struct State {
        T u, wait;  // membrane; what is left of t_ref, in steps
    };

    template <class Values>
    LifB(const Values& value, double dt, Method)
        : k(T(dt) / value(&Params::C_m)), I_leak0(value(&Params::I_leak0)), E_L(value(&Params::E_L)), V_th(value(&Params::V_th)),
          V_reset(value(&Params::V_reset)), drop(V_th - V_reset), ref(value(&Params::t_ref) / dt), refractory(num::any(ref > T(0.0))) {}

    State start() const { return {E_L, T(0.0)}; }
    void show(const State& s, T (&out)[1]) const { out[0] = s.u; }

    /// One sample under current i. Calls fired(mask, offset) for each spike in it; returns where the cap cut it short.
    template <class I, class Fired>
    [[gnu::always_inline]] num::Mask<T> step(State& s, const I& i, Fired&& fired) const {
        const T gain = (i.mean() - I_leak0) * k, end = num::max(s.u + gain, E_L);  // of the whole step
        if (num::any(end > V_th) || i.rises_somewhere_through(I_leak0) || (refractory && num::any(s.wait > T(0.0)))) {
            const auto [now, over] = inside(s, gain, i, fired);
            s = now;
            return over;
        }
        s.u = end;
        return num::none<T>();
    }

private:
    T k, I_leak0, E_L, V_th, V_reset, drop, ref;
    bool refractory;

    struct Stepped {
        State now;
        num::Mask<T> over;
    };

    /// The same step looked into: u(x) = base + rise.at(x), never below E_L; from where it is no longer held, and between spikes.
    template <class Fired>
    [[gnu::noinline, gnu::cold]] Stepped inside(State s, T gain, Current<T> i, Fired& fired) const {
        const T a = (i.from - I_leak0) * k;
        const Parabola<T> rise{a, T(2.0) * (gain - a)};
        T x = num::min(s.wait, T(1.0)), base = s.u;
        s.wait = s.wait - x;
        s.u = num::max(base + gain, E_L);
        const num::Mask<T> bends = i.rises_through(I_leak0) | (x > T(0.0));
        base = num::select(bends, num::max(base - rise.at(x), E_L - rise.least_after(x)), base);
        s.u = num::select(bends, num::max(base + gain, E_L), s.u);
        num::Mask<T> over = s.u > V_th;
        for (int pass = 0; num::any(over) && pass < spikes_a_step; ++pass) {
            x = num::select(over, offset_from(rise.rises_through(V_th - base), x), x);
            fired(over, x);
            T next = base - drop;
            if (refractory) {
                const T free = x + ref, from = num::min(free, T(1.0));
                s.wait = num::select(over, free - from, s.wait);
                next = num::select(ref > T(0.0), V_reset - rise.at(from), next);
            }
            base = num::select(over, next, base);
            s.u = num::select(over, num::max(base + gain, E_L), s.u);
            over = over & (s.u > V_th);
        }
        return {s, over};
    }
};

}  // namespace corpuscle
