#pragma once

#include "model/current.hpp"
#include "signal/afferent.hpp"
#include "signal/parameter.hpp"

namespace corpuscle {

/// FA-IA, Lee et al. 2016:   I_+ = k max{F', 0},   I_- = k max{-F', 0}. Each current drives its own neuron; the spikes of both form one
/// train.
/// (thesis eq. 2 to 4, Alg. 2; errata: the test is on F[n] - F[n-1], and a gain k turns N/s into A.)
struct Fa1aTraits {
    struct Params {
        double k = 100e-9;
    };
    static constexpr std::string_view name = "fa1a", description = "FA-IA: one neuron for rising and one for falling force";
    static constexpr std::string_view source = "Lee et al. 2016; thesis eq. 2 to 4, Alg. 2; the value is a choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"k", &Params::k, "A s/N", 0, 1, "gain from the slope of the force to current"},
    };
    static constexpr int outputs = 2;
    static constexpr bool scales_with_force = true;  ///< twice the force gives twice the current
    static constexpr std::string_view signs[] = {"+", "-"};
};

template <class T>
struct Fa1a : Fa1aTraits {
    struct State {
        T F;
    };

    template <class Values>
    Fa1a(const Values& value, double dt, Method) : kT(value(&Params::k) / dt) {}

    State start(T F) const { return {F}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T slope = kT * (F - s.F), up = num::positive_part(slope), down = num::positive_part(-slope);
        i[0] = {up, up};
        i[1] = {down, down};
        s.F = F;
    }

private:
    T kT;
};

}  // namespace corpuscle
