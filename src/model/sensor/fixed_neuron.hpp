#pragma once
// The thesis's neurons, Algorithms 3 and 4 as corrected, and the adaptive neuron, in fixed-point words: currents in uA, membrane potentials
// in V. At most one spike per step, as in the algorithms. If a neuron is still above its threshold after the reset, its step is reported as
// truncated. doc/fixed-point.md lists the algorithms line by line.

#include "model/neuron/adaptive.hpp"
#include "model/neuron/lif_a.hpp"
#include "model/neuron/lif_b.hpp"
#include "model/parameter_values.hpp"
#include "model/sensor/fixed_point.hpp"

namespace corpuscle {

/// Result of one step of a neuron: whether it fired, and whether it is above its threshold after the reset.
struct NeuronStep {
    bool spike = false, truncated = false;
};

/// Common to the three neurons: the reset at a spike, and the refractory steps at V_reset after it. `wait` is the neuron's number of
/// remaining refractory steps, `theta` its threshold.
struct FixedReset {
    Word V_reset, ref;  // ref: refractory time t_ref, in steps

    template <class Values>
    FixedReset(const Values& value, double f_s, Constants& c)
        : V_reset(c.level("V_reset", value("V_reset"))), ref(c.count("ref", value("t_ref") * f_s)) {}

    /// Counts down one refractory step; false if the neuron is not refractory.
    static bool count_refractory_step(Word& wait) {
        if (wait == 0) return false;
        --wait;
        return true;
    }
    /// Resets a neuron that fires: to V_reset if there is a refractory time, otherwise by theta - V_reset.
    NeuronStep fire(Word& u, Word& wait, Word theta, Arithmetic& a) const {
        u = ref > 0 ? V_reset : a.saturate(u - theta + V_reset);
        wait = ref;
        return {true, u > theta};
    }
};

/// Alg. 3, LIF-A.
struct FixedLifA {
    using Traits = LifATraits;
    static constexpr Probe recordables[] = {{"u", "V"}};
    struct State {
        Word u, wait;
    };
    Word V_th;
    FixedReset reset;
    double inertia;   // R_m C_m / T, where T = 1/f_s is the step
    Factor k_a, k_b;  // u[n] = k_a I[n] + k_b u[n-1] + k_c: backward Euler
    Word k_c, E_L;

    FixedLifA(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : V_th(c.level("V_th", value("V_th"))), reset(value, f_s, c), inertia(value("R_m") * value("C_m") * f_s),
          k_a(c.factor("k_a", value("R_m") / uA_per_A / (1 + inertia))), k_b(c.factor("k_b", inertia / (1 + inertia))),
          k_c(c.level("k_c", value("E_L") / (1 + inertia))), E_L(c.level("E_L", value("E_L"))) {}

    State start() const { return {E_L, 0}; }
    void record(const State& s, Word* out) const { out[0] = s.u; }
    NeuronStep step(State& s, Word I, Arithmetic& a) const {
        if (FixedReset::count_refractory_step(s.wait)) return {};
        s.u = a.saturate(a.times(k_a, I) + a.times(k_b, s.u) + k_c);
        return s.u > V_th ? reset.fire(s.u, s.wait, V_th, a) : NeuronStep{};
    }
};

/// Alg. 4, LIF-B.
struct FixedLifB {
    using Traits = LifBTraits;
    static constexpr Probe recordables[] = {{"u", "V"}};
    struct State {
        Word u, wait;
    };
    Word V_th;
    FixedReset reset;
    Factor k;  // k_m = T / C_m, V per uA
    Word I_leak0, E_L;

    FixedLifB(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : V_th(c.level("V_th", value("V_th"))), reset(value, f_s, c), k(c.factor("k_m", 1 / (value("C_m") * f_s * uA_per_A))),
          I_leak0(c.level("I_leak0", value("I_leak0") * uA_per_A)), E_L(c.level("E_L", value("E_L"))) {}

    State start() const { return {E_L, 0}; }
    void record(const State& s, Word* out) const { out[0] = s.u; }
    NeuronStep step(State& s, Word I, Arithmetic& a) const {
        if (FixedReset::count_refractory_step(s.wait)) return {};
        s.u = a.saturate(s.u + a.times(k, a.saturate(I - I_leak0)));
        if (s.u > V_th) return reset.fire(s.u, s.wait, V_th, a);
        s.u = std::max(s.u, E_L);
        return {};
    }
};

/// The neuron with an adaptive threshold V_th + a.
struct FixedAdaptive {
    using Traits = AdaptiveTraits;
    static constexpr Probe recordables[] = {{"u", "V"}, {"a", "V"}};
    struct State {
        Word u, a, wait;
    };
    Word V_th;
    FixedReset reset;
    Factor k, k_th;  // k_m = T / C_m, V per uA; decay factor of a in one step
    Word dV_th, E_L;

    FixedAdaptive(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : V_th(c.level("V_th", value("V_th"))), reset(value, f_s, c), k(c.factor("k_m", 1 / (value("C_m") * f_s * uA_per_A))),
          k_th(c.factor("k_th", num::exp(-1 / (value("tau_th") * f_s)))), dV_th(c.level("dV_th", value("dV_th"))),
          E_L(c.level("E_L", value("E_L"))) {}

    State start() const { return {E_L, 0, 0}; }
    void record(const State& s, Word* out) const { out[0] = s.u, out[1] = s.a; }
    NeuronStep step(State& s, Word I, Arithmetic& a) const {
        s.a = a.times(k_th, s.a);
        if (FixedReset::count_refractory_step(s.wait)) return {};
        s.u = std::max(a.saturate(s.u + a.times(k, I)), E_L);
        const Word theta = a.saturate(V_th + s.a);
        if (!(I > 0 && s.u > theta)) return {};
        const auto fired = reset.fire(s.u, s.wait, theta, a);
        s.a = a.saturate(s.a + dV_th);
        return fired;
    }
};

}  // namespace corpuscle
