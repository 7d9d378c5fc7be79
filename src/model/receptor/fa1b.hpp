#pragma once

#include "model/current.hpp"

namespace corpuscle {

/// FA-IB, the thesis's proposal:   I = I_A + I_B,   I_A = k_A max{I_0, 0},   I_B = k_B max{-I_0, 0},   I_0' + 2 pi f I_0 = F'
/// (thesis 3.4, Alg. 6, with a correction of its errata: falling force excites too, although the printed sign would suppress it. I_0 is the
/// high-passed force, in newtons.)
struct Fa1bTraits {
    static constexpr std::string_view name = "fa1b", description = "FA-IB: a slow high-pass, rectified with a gain for each direction";
    static constexpr std::string_view source = "thesis 3.4, Alg. 6";
    static constexpr ParameterInfo parameters[] = {
        {"k_A", "A/N", 3.5e-6, 0, 1, "gain for rising force (protraction)"},
        {"k_B", "A/N", 2.75e-6, 0, 1, "gain for falling force (retraction)"},
        {"f", "Hz", 2, 1e-6, 1e6, "cutoff frequency of the high-pass"},
    };
    static constexpr int outputs = 1;
    /// Exact method: the current at the beginning of a step equals the current at the end of the step before. Backward Euler: it is
    /// constant within a step.
    static constexpr bool continuous = true;
    /// True: after a NaN force the state stays NaN, so that checking the state once per block is enough.
    static constexpr bool propagates_nan = true;
    static constexpr bool scales_with_force = true;  ///< twice the force gives twice the current
    static constexpr Probe recordables[] = {{"I_A", "A"}, {"I_B", "A"}};
};

template <class T>
struct Fa1b : Fa1bTraits {
    struct State {
        T F, x, I;  // at the last sample: force (N), high-passed force I_0 (N) and current (A)
    };

    template <class Values>
    Fa1b(const Values& value, double dt, Method method)
        : k_A(value("k_A")), k_B(value("k_B")), filter(value("f"), dt, method), first_order_hold(method == Method::exact) {}

    State start(T F) const { return {F, T(0.0), T(0.0)}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T before = s.I;
        s.x = filter.next(s.x, F - s.F);
        s.F = F, s.I = current(s);
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    T current(const State& s) const { return k_A * num::positive_part(s.x) + k_B * num::positive_part(-s.x); }
    void flush_decayed(State& s) const { s.x = snap_to_level(s.x, negligible_force), s.I = current(s); }
    void record(const State& s, T (&out)[2]) const { out[0] = k_A * num::positive_part(s.x), out[1] = k_B * num::positive_part(-s.x); }

private:
    T k_A, k_B;
    HighPass<T> filter;
    bool first_order_hold;  // true: the exact method
};

}  // namespace corpuscle
