#pragma once

#include "model/current.hpp"
#include "model/neuron/threshold_crossing.hpp"

namespace corpuscle {

/// LIF-B, the thesis's leaky integrate-and-fire neuron with a constant leak, integrated exactly for a straight-line current:
///
///     C_m du/dt = I - I_leak0, but u is never below E_L;   u > V_th  =>  spike, then u = V_reset for t_ref
///
/// (thesis eq. 6, 7, Alg. 4, with a correction of its errata: the algorithm adds to u[n-1], not to u_rest. The thesis writes C, theta,
/// u_rst, u_rest.) Method has no effect. Limitation: if u exceeds V_th within a step and is below it again at the end, no spike is
/// detected.
struct LifBTraits {
    static constexpr std::string_view name = "lif-b", description = "LIF-B: integrate and fire with a constant leak current";
    static constexpr std::string_view source = "thesis 3.2, eq. 6, 7, Alg. 4";
    static constexpr ParameterInfo parameters[] = {
        {"C_m", "F", 500e-9, 1e-18, 1, "membrane capacitance (C)", "thesis 3.3"},
        {"I_leak0", "A", 500e-9, 0, 1, "leak current above E_L, which is the rheobase", "thesis 3.3"},
        {"E_L", "V", 0, -10, 10, "resting potential (u_rest)", "thesis fig. 16"},
        {"V_th", "V", 0.5, -10, 10, "threshold (theta)", "choice: not given in the thesis"},
        {"V_reset", "V", 0.25, -10, 10, "potential after a spike (u_rst)", "choice: not given in the thesis"},
        {"t_ref", "s", 0, 0, 10, "refractory time", "thesis: none"},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"V_reset", "V_th"},
        {"E_L", "V_reset", true},
    };
    static constexpr Probe recordables[] = {{"u", "V"}};
};

/// The membrane is stored as a charge, expressed as the current that delivers it in half a step: q = 2 C_m u / dt, in A. A whole step under
/// a straight-line current then adds the sum of the currents at its ends minus twice the leak.
template <class T>
struct LifB : LifBTraits {
    struct State {
        T q, ref_steps;  // charge of the membrane, in A as above; remaining refractory time, in steps
    };
    /// Number of values at the end of State that are always 0 if may_be_refractory() is false.
    static constexpr std::size_t refractory_values = 1;

    template <class Values>
    LifB(const Values& value, double dt, Method)
        : C(T(2.0) * value("C_m") / dt), I_leak0(value("I_leak0")), leak(T(2.0) * I_leak0), rest(C * value("E_L")),
          theta(C * value("V_th")), reset(C * value("V_reset")), drop(theta - reset), ref(value("t_ref") / dt),
          refractory(num::any(ref > T(0.0))) {}

    State start() const { return {rest, T(0.0)}; }
    void record(const State& s, T (&out)[1]) const { out[0] = s.q / C; }

    /// Computes `next`, the state after a step in which nothing happens: no spike, no current that rises through the leak, no refractory
    /// time. Returns the lanes in which one of these events is possible, for which `next` is not valid. `check_refractory`: false if no
    /// lane can be refractory, so that this needs no test.
    template <bool check_refractory, class I>
    [[gnu::always_inline]] num::Mask<T> try_quiet_step(const State& s, const I& i, State& next) const {
        next = {num::max(rest, s.q + (i.sum() - leak)), s.ref_steps};
        num::Mask<T> events = next.q > theta;
        if (i.may_rise()) events = events | i.rises_through(I_leak0);
        if (check_refractory) events = events | (s.ref_steps > T(0.0));
        return events;
    }
    bool may_be_refractory() const { return refractory; }  ///< true if t_ref is above 0 on a lane

    /// Simulates one step under current i. For each spike calls fired(mask, offset): the lanes that fire, and the offset of the spike
    /// within the step. Returns the lanes that reached the limit of spikes in the step.
    template <class I, class Fired>
    [[gnu::always_inline]] num::Mask<T> step(State& s, const I& i, Fired&& fired) const {
        State next;
        if (num::any(refractory ? try_quiet_step<true>(s, i, next) : try_quiet_step<false>(s, i, next))) {
            const auto [end, over] = step_with_events(s, i.sum() - leak, i, fired);
            s = end;
            return over;
        }
        s = next;
        return num::empty_mask<T>();
    }

private:
    // C = 2 C_m / dt; leak = 2 I_leak0, for a whole step. rest, theta and reset are E_L, V_th and V_reset as charges in A; drop = theta -
    // reset.
    T C, I_leak0, leak, rest, theta, reset, drop, ref;  // ref = t_ref / dt
    bool refractory;                                    // true if t_ref is above 0 on a lane

    struct StepResult {
        State end;
        num::Mask<T> over;  // the lanes that reached the limit of spikes
    };

    /// A step with all events. Times within the step are 0 at its beginning and 1 at its end. From time x on, which is the end of the
    /// refractory time or the last spike, the charge is q(y) = base + rise.at(y) until the next spike. `increment` is rise.at(1).
    template <class Fired>
    [[gnu::noinline, gnu::cold]] StepResult step_with_events(State s, T increment, Current<T> i, Fired& fired) const {
        const Parabola<T> rise{T(2.0) * (i.from - I_leak0), T(2.0) * (i.to - i.from)};
        T x = num::min(s.ref_steps, T(1.0)), base = s.q;
        s.ref_steps = s.ref_steps - x;
        // s.q is always the charge at the end of the step, as far as spikes have been fired.
        s.q = num::max(rest, base + increment);
        const num::Mask<T> bends = i.rises_through(I_leak0) | (x > T(0.0));  // lanes in which q is held at E_L or V_reset at first
        base = num::select(bends, num::max(base - rise.at(x), rest - rise.min_from(x)), base);
        s.q = num::select(bends, num::max(rest, base + increment), s.q);
        num::Mask<T> over = s.q > theta;
        for (int pass = 0; num::any(over) && pass < max_spikes_per_step; ++pass) {
            x = num::select(over, spike_offset(rise.rising_crossing(theta - base), x), x);
            fired(over, x);
            T next = base - drop;
            if (refractory) {
                const T end = x + ref, from = num::min(end, T(1.0));
                s.ref_steps = num::select(over, end - from, s.ref_steps);
                next = num::select(ref > T(0.0), reset - rise.at(from), next);
            }
            base = num::select(over, next, base);
            s.q = num::select(over, num::max(rest, base + increment), s.q);
            over = over & (s.q > theta);
        }
        return {s, over};
    }
};

}  // namespace corpuscle
