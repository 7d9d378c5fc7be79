#pragma once

#include "core/afferent.hpp"
#include "core/parameter.hpp"
#include "model/current.hpp"

namespace corpuscle {

/// I = k F
struct ProportionalTraits {
    static constexpr std::string_view name = "proportional", description = "a current proportional to the force", source = "choice";
    static constexpr ParameterInfo parameters[] = {{"k", "A/N", 1e-6, 0, 1, "gain"}};
    static constexpr int outputs = 1;
    static constexpr Probe recordables[] = {{"I_k", "A"}};
};

template <class T>
struct Proportional : ProportionalTraits {
    struct State {
        T I;  // A
    };
    template <class Values>
    Proportional(const Values& value, double, Method method) : k(value("k")), first_order_hold(method == Method::exact) {}

    State start(T F) const { return {k * F}; }
    void step(State& s, T F, Current<T> (&i)[outputs]) const {
        const T before = s.I;
        s.I = k * F;
        i[0] = {first_order_hold ? before : s.I, s.I};
    }
    void record(const State& s, T (&out)[1]) const { out[0] = s.I; }

private:
    T k;
    bool first_order_hold;
};

}  // namespace corpuscle
