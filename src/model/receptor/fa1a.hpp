#pragma once

#include "model/current.hpp"

namespace corpuscle {

/// FA-IA, Lee et al. 2016:   I_+ = k max{F', 0},   I_- = k max{-F', 0}. Each current drives its own neuron; the spikes of both form one
/// train.
/// (thesis eq. 2 to 4, Alg. 2, with two corrections of its errata: the test is on F[n] - F[n-1], and a gain k turns N/s into A.)
/// The slope F' is known only as a difference over a step, so the currents are constant within a step. Method has no effect.
struct Fa1aTraits {
    static constexpr std::string_view name = "fa1a", description = "FA-IA: one neuron for rising and one for falling force";
    static constexpr std::string_view source = "Lee et al. 2016; thesis eq. 2 to 4, Alg. 2; the value is a choice";
    static constexpr ParameterInfo parameters[] = {
        {"k", "A s/N", 100e-9, 0, 1, "gain from the slope of the force to the current"},
    };
    static constexpr int outputs = 2;                        ///< number of currents, each into a neuron of its own
    static constexpr bool scales_with_force = true;          ///< twice the force gives twice the current
    static constexpr std::string_view signs[] = {"+", "-"};  ///< of the two currents, for the names of probes
};

template <class T>
struct Fa1a : Fa1aTraits {
    struct State {
        T F;  // force of the last sample, N
    };

    template <class Values>
    Fa1a(const Values& value, double dt, Method) : k_by_dt(value("k") / dt) {}

    State start(T F) const { return {F}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T k_slope = k_by_dt * (F - s.F), I_plus = num::positive_part(k_slope), I_minus = num::positive_part(-k_slope);
        i[0] = {I_plus, I_plus};
        i[1] = {I_minus, I_minus};
        s.F = F;
    }

private:
    T k_by_dt;  // k / dt, A/N
};

}  // namespace corpuscle
