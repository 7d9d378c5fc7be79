#pragma once

#include "model/receptor/filter_blocks.hpp"

namespace corpuscle {

/// A receptor for changes of force, used for FA-I and FA-II:   I = I_0 asinh((k_A max{x, 0} + k_B max{-x, 0}) / F_0)
/// x: the force F after two high-passes at f_hp and two low-passes at f_lp
///
/// The structure extends FA-IB of the thesis (3.4): its high-pass and its rectifier with a gain for each direction, then the upper corner of
/// the skin and a compression, so that a nerve answers millinewtons and newtons. Limitation: each filter treats its input as a straight line
/// between samples, so the sampling rate should be several times f_lp.
struct FastAdaptingTraits {
    static constexpr std::string_view name = "fast-adapting",
                                      description = "a band of frequencies, rectified with a gain for each direction, compressed";
    static constexpr std::string_view source = "extends thesis 3.4; defaults are fa1-nerve's (doc/nerve-data.md)";
    static constexpr double min_rate = 1000;  ///< Hz; below this sampling rate part of the band is lost
    static constexpr ParameterInfo parameters[] = {
        {"k_A", "", 1, 0, 1e3, "gain for the band-passed force where it is positive"},
        {"k_B", "", 0, 0, 1e3, "gain where it is negative"},
        {"f_hp", "Hz", 60, 1e-6, 1e6, "cutoff frequency of the two high-passes"},
        {"f_lp", "Hz", 114, 1e-6, 1e6, "cutoff frequency of the two low-passes"},
        {"F_0", "N", 100e-6, 1e-12, 1e3, "band-passed force at which the compression begins"},
        {"I_0", "A", 1e-6, 0, 1, "scale of the current"},
    };
    static constexpr int outputs = 1;
    /// Exact method: the current at the beginning of a step equals the current at the end of the step before. Backward Euler: it is
    /// constant within a step.
    static constexpr bool continuous = true;
    /// True: after a NaN force the state stays NaN, so that checking the state once per block is enough.
    static constexpr bool propagates_nan = true;
    static constexpr Probe recordables[] = {{"x", "N"}};
};

template <class T>
struct FastAdapting : FastAdaptingTraits {
    struct State {
        // Values at the last sample: force F, outputs x_1 and x_2 of the high-passes (N), the low-passes, current I (A).
        T F, x_1, x_2;
        typename TwoLowPasses<T>::State low;
        T I;
    };

    template <class Values>
    FastAdapting(const Values& value, double dt, Method method)
        : k_A(value("k_A")), k_B(value("k_B")), high(value("f_hp"), dt, method), low{HighPass<T>(value("f_lp"), dt, method)},
          compression(value("I_0"), value("F_0")), feels_fall(num::any(k_B > T(0.0))), first_order_hold(method == Method::exact) {}

    State start(T F) const { return {F, T(0.0), T(0.0), TwoLowPasses<T>::start(T(0.0)), T(0.0)}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T before = s.I, x_1 = high.next(s.x_1, F - s.F), x_2 = high.next(s.x_2, x_1 - s.x_1);
        low.step(s.low, x_2);
        s.F = F, s.x_1 = x_1, s.x_2 = x_2, s.I = current(s);
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    T current(const State& s) const {
        const T x = low.output(s.low);
        const T rise = k_A * num::positive_part(x);
        return compression(feels_fall ? rise + k_B * num::positive_part(T(-1.0) * x) : rise);
    }
    void flush_decayed(State& s) const {
        s.x_1 = snap_to_level(s.x_1, negligible_force), s.x_2 = snap_to_level(s.x_2, negligible_force);
        s.low.in_1 = s.x_2;
        low.flush_decayed(s.low);
        s.I = current(s);
    }
    void record(const State& s, T (&out)[1]) const { out[0] = low.output(s.low); }

private:
    T k_A, k_B;
    HighPass<T> high;
    TwoLowPasses<T> low;
    Compression<T> compression;
    bool feels_fall;        // false: k_B is 0, and its term is left out
    bool first_order_hold;  // true: the exact method
};

}  // namespace corpuscle
