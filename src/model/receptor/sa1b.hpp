#pragma once

#include "model/current.hpp"

namespace corpuscle {

/// SA-IB, the thesis's proposal:   I = I_A + max{I_B, 0} + max{I_C, 0},   I_A = k_A F,   I_x' + 2 pi f_x I_x = K_x F'   for x = B, C
/// (thesis eq. 8 to 12, Alg. 5, whose signs and names are corrected as in the errata: I_x[n] = k_x2 (K_x (F[n] - F[n-1]) + I_x[n-1]) with
/// k_x2 = 1 / (1 + 2 pi f_x dt).)
/// Between samples the current is approximated by a straight line: the error of a spike time decreases with dt^2.
struct Sa1bTraits {
    static constexpr std::string_view name = "sa1b", description = "SA-IB: static part plus two rectified high-passes, one fast, one slow";
    static constexpr std::string_view source = "thesis 3.3, eq. 8 to 12, Alg. 5";
    static constexpr ParameterInfo parameters[] = {
        {"k_A", "A/N", 1e-6, 0, 1, "gain of the static part I_A"},
        {"K_B", "A/N", 8e-6, 0, 1, "gain of the fast part I_B, active in protraction",
         "thesis 3.3, which prints 8 A/A; here the gain from force to current"},
        {"f_B", "Hz", 20, 1e-6, 1e6, "cutoff frequency of the fast part"},
        {"K_C", "A/N", 2e-6, 0, 1, "gain of the slow part I_C, which decays during the plateau",
         "thesis 3.3, which prints 2 A/A; here the gain from force to current"},
        {"f_C", "Hz", 2, 1e-6, 1e6, "cutoff frequency of the slow part"},
    };
    static constexpr int outputs = 1;
    /// Exact method: the current at the beginning of a step equals the current at the end of the step before. Backward Euler: it is
    /// constant within a step.
    static constexpr bool continuous = true;
    /// True: after a NaN force the state stays NaN, so that checking the state once per block is enough.
    static constexpr bool propagates_nan = true;
    static constexpr bool scales_with_force = true;  ///< twice the force gives twice the current
    static constexpr Probe recordables[] = {{"I_A", "A"}, {"I_B", "A"}, {"I_C", "A"}};
};

template <class T>
struct Sa1b : Sa1bTraits {
    struct State {
        T F, I_B, I_C, I;  // at the last sample: force (N), currents before rectification (A) and total current (A)
    };

    template <class Values>
    Sa1b(const Values& value, double dt, Method method)
        : k_A(value("k_A")), B(value("f_B"), dt, method, value("K_B")), C(value("f_C"), dt, method, value("K_C")),
          first_order_hold(method == Method::exact) {}

    State start(T F) const { return {F, T(0.0), T(0.0), k_A * F}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T dF = F - s.F, before = s.I;
        s.I_B = B.next(s.I_B, dF), s.I_C = C.next(s.I_C, dF);
        s.F = F, s.I = current(s);
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    T current(const State& s) const { return k_A * s.F + num::positive_part(s.I_B) + num::positive_part(s.I_C); }
    void flush_decayed(State& s) const {
        s.I_B = snap_to_level(s.I_B, negligible_current), s.I_C = snap_to_level(s.I_C, negligible_current);
        s.I = current(s);
    }
    void record(const State& s, T (&out)[3]) const { out[0] = k_A * s.F, out[1] = s.I_B, out[2] = s.I_C; }

private:
    T k_A;
    HighPass<T> B, C;       // from force to I_B and I_C
    bool first_order_hold;  // true: the exact method
};

}  // namespace corpuscle
