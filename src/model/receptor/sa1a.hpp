#pragma once

#include "model/current.hpp"

namespace corpuscle {

/// SA-IA, Kim et al. 2012:   I = beta + I_s + I_d,   I_s = k_s F,   I_d = k_d |F'|
/// (thesis eq. 1, Alg. 1, with a correction of its errata: differences of the force are divided by the step.) The slope F' is known only as
/// a difference over a step, so the dynamic part I_d is constant within a step.
struct Sa1aTraits {
    static constexpr std::string_view name = "sa1a", description = "SA-IA: static part plus the absolute slope of the force";
    static constexpr std::string_view source = "Kim et al. 2012, doi 10.1186/1743-0003-9-45; thesis eq. 1, Alg. 1; values are a choice";
    static constexpr ParameterInfo parameters[] = {
        {"beta", "A", 0, -1e-3, 1e-3, "current without force"},
        {"k_s", "A/N", 1e-6, 0, 1, "static gain"},
        {"k_d", "A s/N", 100e-9, 0, 1, "dynamic gain, the same for rising and falling force"},
    };
    static constexpr int outputs = 1;
    static constexpr Probe recordables[] = {{"I_s", "A"}, {"I_d", "A"}};
};

template <class T>
struct Sa1a : Sa1aTraits {
    struct State {
        T F, I_d;  // force of the last sample, N; dynamic part in its step, A
    };

    template <class Values>
    Sa1a(const Values& value, double dt, Method method)
        : beta(value("beta")), k_s(value("k_s")), k_d_by_dt(value("k_d") / dt), first_order_hold(method == Method::exact) {}

    State start(T F) const { return {F, T(0.0)}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        s.I_d = k_d_by_dt * num::abs(F - s.F);
        const T to = beta + k_s * F + s.I_d;
        i[0] = {first_order_hold ? beta + k_s * s.F + s.I_d : to, to};
        s.F = F;
    }
    void record(const State& s, T (&out)[2]) const { out[0] = k_s * s.F, out[1] = s.I_d; }

private:
    T beta, k_s, k_d_by_dt;  // k_d_by_dt: k_d / dt, A/N
    bool first_order_hold;   // true: the exact method
};

}  // namespace corpuscle
