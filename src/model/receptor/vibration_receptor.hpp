#pragma once

#include "model/current.hpp"
#include "signal/afferent.hpp"
#include "signal/parameter.hpp"

namespace corpuscle {

/// A band of vibration, for FA-II:   I = k max{x, 0},   x = F through two high-passes at f_hp and a low-pass at f_lp
///
///     |x / F| = f^2 / (f^2 + f_hp^2) * f_lp / sqrt(f^2 + f_lp^2), with its maximum at sqrt(2) f_hp for f_lp = f_hp
///
/// The equations are our choice, because the thesis names FA-II but does not model it. They reproduce the tuning of Pacinian corpuscles
/// (best at 200 to 300 Hz, no response to slow force), not their mechanics. Each filter treats the output of the filter before it as a
/// straight line between samples.
struct VibrationTraits {
    struct Params {
        double k = 400e-6, f_hp = 180, f_lp = 180;
    };
    static constexpr std::string_view name = "vibration", description = "a band of vibration: two high-passes and a low-pass, rectified";
    static constexpr std::string_view source = "choice, after the tuning of PC afferents in PMC2657072, table 1";
    static constexpr double min_rate = 1000;  ///< Hz; below this sampling rate part of the band is lost
    static constexpr ParameterDef<Params> fields[] = {
        {"k", &Params::k, "A/N", 0, 1, "gain"},
        {"f_hp", &Params::f_hp, "Hz", 1e-6, 1e6, "cutoff frequency of the two high-passes"},
        {"f_lp", &Params::f_lp, "Hz", 1e-6, 1e6, "cutoff frequency of the low-pass"},
    };
    static constexpr int outputs = 1;
    /// Exact method: the current at the beginning of a step equals the current at the end of the step before. Backward Euler: it is
    /// constant within a step.
    static constexpr bool continuous = true;
    static constexpr bool propagates_nan = true;     ///< after a NaN force the state stays NaN, so one check per block is enough
    static constexpr bool scales_with_force = true;  ///< twice the force gives twice the current
};

template <class T>
struct Vibration : VibrationTraits {
    struct State {
        T F, x_1, x_2, x_3, I;
    };

    template <class Values>
    Vibration(const Values& value, double dt, Method method)
        : k(value(&Params::k)), high(value(&Params::f_hp), dt, method), low(value(&Params::f_lp), dt, method),
          first_order_hold(method == Method::exact) {}

    State start(T F) const { return {F, T(0.0), T(0.0), T(0.0), T(0.0)}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T before = s.I, x_1 = high.next(s.x_1, F - s.F), x_2 = high.next(s.x_2, x_1 - s.x_1), x_3 = low.next(s.x_3, x_2 - s.x_2);
        s.F = F, s.x_1 = x_1, s.x_2 = x_2, s.x_3 = x_3, s.I = current(s);
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    T current(const State& s) const { return k * num::positive_part(s.x_2 - s.x_3); }  // a low-pass is its input minus a high-pass
    void flush_decayed(State& s) const {
        s.x_1 = snap_to_level(s.x_1, negligible_force), s.x_2 = snap_to_level(s.x_2, negligible_force),
        s.x_3 = snap_to_level(s.x_3, negligible_force);
        s.I = current(s);
    }

private:
    T k;
    HighPass<T> high, low;
    bool first_order_hold;
};

}  // namespace corpuscle
