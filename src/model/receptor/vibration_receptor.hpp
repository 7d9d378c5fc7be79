#pragma once

#include "model/current.hpp"

namespace corpuscle {

/// A receptor for a band of vibration, used for FA-II:   I = k max{x, 0},   x: the force F after two high-passes at f_hp and a low-pass at
/// f_lp
///
/// For a sine of frequency f the gain of the filters is
///
///     |x / F| = f^2 / (f^2 + f_hp^2) * f_lp / sqrt(f^2 + f_lp^2), with its maximum at sqrt(2) f_hp for f_lp = f_hp
///
/// The equations are our choice, because the thesis names FA-II but does not model it. They reproduce the tuning of Pacinian corpuscles
/// (best at 200 to 300 Hz, no response to slow force), not their mechanics. Each filter treats the output of the filter before it as a
/// straight line between samples.
struct VibrationTraits {
    static constexpr std::string_view name = "vibration", description = "a band of vibration: two high-passes and a low-pass, rectified";
    static constexpr std::string_view source = "choice, after the tuning of PC afferents in PMC2657072, table 1";
    static constexpr double min_rate = 1000;  ///< Hz; below this sampling rate part of the band is lost
    static constexpr ParameterInfo parameters[] = {
        {"k", "A/N", 400e-6, 0, 1, "gain from the filtered force to the current"},
        {"f_hp", "Hz", 180, 1e-6, 1e6, "cutoff frequency of the two high-passes"},
        {"f_lp", "Hz", 180, 1e-6, 1e6, "cutoff frequency of the low-pass"},
    };
    static constexpr int outputs = 1;
    /// Exact method: the current at the beginning of a step equals the current at the end of the step before. Backward Euler: it is
    /// constant within a step.
    static constexpr bool continuous = true;
    /// True: after a NaN force the state stays NaN, so that checking the state once per block is enough.
    static constexpr bool propagates_nan = true;
    static constexpr bool scales_with_force = true;  ///< twice the force gives twice the current
};

template <class T>
struct Vibration : VibrationTraits {
    struct State {
        // Values at the last sample: force F, outputs x_1 and x_2 of the high-passes at f_hp and x_3 of that at f_lp (N), current I (A).
        T F, x_1, x_2, x_3, I;
    };

    template <class Values>
    Vibration(const Values& value, double dt, Method method)
        : k(value("k")), high(value("f_hp"), dt, method), low(value("f_lp"), dt, method), first_order_hold(method == Method::exact) {}

    State start(T F) const { return {F, T(0.0), T(0.0), T(0.0), T(0.0)}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T before = s.I, x_1 = high.next(s.x_1, F - s.F), x_2 = high.next(s.x_2, x_1 - s.x_1), x_3 = low.next(s.x_3, x_2 - s.x_2);
        s.F = F, s.x_1 = x_1, s.x_2 = x_2, s.x_3 = x_3, s.I = current(s);
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    /// x_2 - x_3 is x_2 after the low-pass at f_lp, because a low-pass and a high-pass with the same cutoff add up to their input.
    T current(const State& s) const { return k * num::positive_part(s.x_2 - s.x_3); }
    void flush_decayed(State& s) const {
        s.x_1 = snap_to_level(s.x_1, negligible_force), s.x_2 = snap_to_level(s.x_2, negligible_force),
        s.x_3 = snap_to_level(s.x_3, negligible_force);
        s.I = current(s);
    }

private:
    T k;
    HighPass<T> high, low;  // high-passes at f_hp and at f_lp
    bool first_order_hold;  // true: the exact method
};

}  // namespace corpuscle
