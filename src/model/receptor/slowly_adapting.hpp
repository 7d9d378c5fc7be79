#pragma once

#include "model/receptor/filter_blocks.hpp"

namespace corpuscle {

/// A receptor for held force, used for SA-I and SA-II:   I = I_0 asinh(max{r + k_A max{x, 0} + k_B max{-x, 0}, 0} / F_0)
/// r: the force F after slow adaptation, F (1 - g_1 - g_2 - g_3) + g_1 h_1 + g_2 h_2 + g_3 h_3, where h_i is F after a high-pass with the
///    time constant tau_i
/// x: the force F after a high-pass at f_hp
/// r and x pass two low-passes at f_lp.
///
/// The structure extends SA-IB of the thesis (3.3): a static part, a slow part that decays during the plateau, and a fast part. The slow
/// parts are those of quasi-linear viscoelasticity (Fung), the compression makes the rate grow less than the force. Limitation: each filter
/// treats its input as a straight line between samples.
struct SlowlyAdaptingTraits {
    static constexpr std::string_view name = "slowly-adapting",
                                      description = "held force with three slow adaptations, and its changes, compressed";
    static constexpr std::string_view source = "extends thesis 3.3; defaults are sa1-nerve's (doc/nerve-data.md)";
    static constexpr ParameterInfo parameters[] = {
        {"k_A", "", 6, 0, 1e4, "gain for rising force"},
        {"k_B", "", 0, 0, 1e4, "gain for falling force"},
        {"f_hp", "Hz", 7, 1e-6, 1e6, "cutoff frequency of the high-pass for changes of force"},
        {"f_lp", "Hz", 84, 1e-6, 1e6, "cutoff frequency of the two low-passes"},
        {"g_1", "", 0.14, 0, 0.33, "part of the held force that adapts with tau_1"},
        {"g_2", "", 0.23, 0, 0.33, "part that adapts with tau_2"},
        {"g_3", "", 0.3, 0, 0.33, "part that adapts with tau_3"},
        {"tau_1", "s", 0.1, 1e-6, 1e6, "time constant of fast adaptation"},
        {"tau_2", "s", 1, 1e-6, 1e6, "time constant of adaptation within a touch"},
        {"tau_3", "s", 10, 1e-6, 1e6, "time constant of slow adaptation"},
        {"F_0", "N", 23e-3, 1e-12, 1e3, "filtered force at which the compression begins"},
        {"I_0", "A", 1e-6, 0, 1, "scale of the current"},
    };
    static constexpr int outputs = 1;
    /// Exact method: the current at the beginning of a step equals the current at the end of the step before. Backward Euler: it is
    /// constant within a step.
    static constexpr bool continuous = true;
    /// True: after a NaN force the state stays NaN, so that checking the state once per block is enough.
    static constexpr bool propagates_nan = true;
    static constexpr Probe recordables[] = {{"r", "N"}, {"x", "N"}};
};

template <class T>
struct SlowlyAdapting : SlowlyAdaptingTraits {
    struct State {
        // Values at the last sample: force F, outputs of the three adaptations and of the high-pass (N), the low-passes of the adapted force
        // and of its changes, current I (A).
        T F, h_1, h_2, h_3, x;
        typename TwoLowPasses<T>::State held, change;
        T I;
    };

    template <class Values>
    SlowlyAdapting(const Values& value, double dt, Method method)
        : k_A(value("k_A")), k_B(value("k_B")), g_1(value("g_1")), g_2(value("g_2")), g_3(value("g_3")), lasting(T(1.0) - g_1 - g_2 - g_3),
          high(value("f_hp"), dt, method), adapt_1(cutoff(value("tau_1")), dt, method), adapt_2(cutoff(value("tau_2")), dt, method),
          adapt_3(cutoff(value("tau_3")), dt, method), low{HighPass<T>(value("f_lp"), dt, method)},
          compression(value("I_0"), value("F_0")), feels_fall(num::any(k_B > T(0.0))), first_order_hold(method == Method::exact) {}

    /// The state of a force that was always F.
    State start(T F) const {
        State s{F, T(0.0), T(0.0), T(0.0), T(0.0), TwoLowPasses<T>::start(lasting * F), TwoLowPasses<T>::start(T(0.0)), T(0.0)};
        s.I = current(s);
        return s;
    }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T before = s.I, dF = F - s.F;
        s.h_1 = adapt_1.next(s.h_1, dF), s.h_2 = adapt_2.next(s.h_2, dF), s.h_3 = adapt_3.next(s.h_3, dF), s.x = high.next(s.x, dF);
        s.F = F;
        low.step(s.held, adapted(s)), low.step(s.change, s.x);
        s.I = current(s);
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    T current(const State& s) const {
        const T x = low.output(s.change);
        const T y = low.output(s.held) + k_A * num::positive_part(x);
        return compression(feels_fall ? y + k_B * num::positive_part(T(-1.0) * x) : y);
    }
    void flush_decayed(State& s) const {
        for (T* h : {&s.h_1, &s.h_2, &s.h_3}) *h = snap_to_level(*h, negligible_adaptation);
        s.x = snap_to_level(s.x, negligible_force);
        s.held.in_1 = adapted(s), s.change.in_1 = s.x;
        low.flush_decayed(s.held), low.flush_decayed(s.change);
        s.I = current(s);
    }
    void record(const State& s, T (&out)[2]) const { out[0] = low.output(s.held), out[1] = low.output(s.change); }

private:
    /// An adaptation is set to zero below this (N), a billionth of a usual F_0: otherwise a skin would compute for minutes after a touch.
    static constexpr double negligible_adaptation = 1e-11;

    T k_A, k_B, g_1, g_2, g_3, lasting;  // lasting: the part of the force that does not adapt
    HighPass<T> high, adapt_1, adapt_2, adapt_3;
    TwoLowPasses<T> low;
    Compression<T> compression;
    bool feels_fall;        // false: k_B is 0, and its term is left out
    bool first_order_hold;  // true: the exact method

    /// The cutoff frequency of a filter with time constant tau, Hz.
    static T cutoff(T tau) { return T(0.15915494309189535) / tau; }
    /// The force after adaptation, N.
    T adapted(const State& s) const { return lasting * s.F + g_1 * s.h_1 + g_2 * s.h_2 + g_3 * s.h_3; }
};

}  // namespace corpuscle
