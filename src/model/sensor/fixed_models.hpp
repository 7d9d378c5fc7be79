#pragma once
// The thesis's receptors and neurons, Algorithms 1 to 6 as corrected, and the adaptive neuron, in fixed-point words: force in N, currents
// in uA, membrane potentials in V. One step per conversion, f_s steps per second. doc/fixed-point.md lists the algorithms line by line.

#include "model/neuron/adaptive.hpp"
#include "model/neuron/lif_a.hpp"
#include "model/neuron/lif_b.hpp"
#include "model/parameter_values.hpp"
#include "model/receptor/fa1a.hpp"
#include "model/receptor/fa1b.hpp"
#include "model/receptor/sa1a.hpp"
#include "model/receptor/sa1b.hpp"
#include "model/sensor/fixed_point.hpp"

namespace corpuscle {

// Receptors. F in a state is the force of the previous step.

/// Alg. 1, SA-IA.
struct FixedSa1a {
    using Traits = Sa1aTraits;
    struct State {
        Word F;
    };
    Word beta;
    Factor k_s, k_d;  // uA/N; k_d is the parameter k_d times f_s

    FixedSa1a(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : beta(c.level("beta", value("beta") * uA_per_A)), k_s(c.factor("k_s", value("k_s") * uA_per_A)),
          k_d(c.factor("k_d", value("k_d") * uA_per_A * f_s)) {}

    void step(State& s, Word F, Word (&I)[1], Arithmetic& a) const {
        const Word change = a.magnitude(a.saturate(F - s.F));
        I[0] = a.saturate(beta + a.times(k_s, F) + a.times(k_d, change));
        s.F = F;
    }
};

/// Alg. 2, FA-IA.
struct FixedFa1a {
    using Traits = Fa1aTraits;
    struct State {
        Word F;
    };
    Factor k;  // uA/N: the parameter k times f_s

    FixedFa1a(const ParameterValues<Traits>& value, double f_s, Constants& c) : k(c.factor("k", value("k") * uA_per_A * f_s)) {}

    void step(State& s, Word F, Word (&I)[2], Arithmetic& a) const {
        const Word dF = a.saturate(F - s.F), current = a.times(k, a.magnitude(dF));
        I[0] = dF > 0 ? current : 0;
        I[1] = dF > 0 ? 0 : current;
        s.F = F;
    }
};

/// The decay factor of a high-pass with cutoff frequency f in one step of backward Euler; f and f_s in Hz.
inline double high_pass_decay(double f, double f_s) { return 1 / (1 + 6.283185307179586 * f / f_s); }

/// Alg. 5, SA-IB.
struct FixedSa1b {
    using Traits = Sa1bTraits;
    struct State {
        Word F, I_B, I_C;
    };
    Factor k_A, k_B1, k_B2, k_C1, k_C2;  // k_B2, k_C2: decay factors; k_B1 = K_B k_B2 and k_C1 = K_C k_C2, uA/N

    FixedSa1b(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : k_A(c.factor("k_A", value("k_A") * uA_per_A)),
          k_B1(c.factor("k_B1", value("K_B") * uA_per_A * high_pass_decay(value("f_B"), f_s))),
          k_B2(c.factor("k_B2", high_pass_decay(value("f_B"), f_s))),
          k_C1(c.factor("k_C1", value("K_C") * uA_per_A * high_pass_decay(value("f_C"), f_s))),
          k_C2(c.factor("k_C2", high_pass_decay(value("f_C"), f_s))) {}

    void step(State& s, Word F, Word (&I)[1], Arithmetic& a) const {
        const Word dF = a.saturate(F - s.F);
        s.I_B = a.saturate(a.times(k_B1, dF) + a.times(k_B2, s.I_B));
        s.I_C = a.saturate(a.times(k_C1, dF) + a.times(k_C2, s.I_C));
        I[0] = a.saturate(a.times(k_A, F) + std::max(s.I_B, Word{0}) + std::max(s.I_C, Word{0}));
        s.F = F;
    }
};

/// Alg. 6, FA-IB.
struct FixedFa1b {
    using Traits = Fa1bTraits;
    struct State {
        Word F, I_0;  // I_0: high-passed force; both in N
    };
    Factor k, k_A, k_B;  // k: decay factor; k_A, k_B: uA/N

    FixedFa1b(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : k(c.factor("k", high_pass_decay(value("f"), f_s))), k_A(c.factor("k_A", value("k_A") * uA_per_A)),
          k_B(c.factor("k_B", value("k_B") * uA_per_A)) {}

    void step(State& s, Word F, Word (&I)[1], Arithmetic& a) const {
        s.I_0 = a.times(k, a.saturate(a.saturate(F - s.F) + s.I_0));
        I[0] = s.I_0 > 0 ? a.times(k_A, s.I_0) : a.times(k_B, a.magnitude(s.I_0));
        s.F = F;
    }
};

// Neurons: at most one spike per step, as in the algorithms. If a neuron is still above its threshold after the reset, its step is reported
// as truncated.

/// Result of one step of a neuron: whether it fired, and whether it is above its threshold after the reset.
struct NeuronStep {
    bool spike = false, truncated = false;
};

/// Common to the three neurons: the state, the reset at a spike, and the refractory steps at V_reset after it. `theta` is the threshold.
struct FixedMembrane {
    static constexpr Probe recordables[] = {{"u", "V"}};
    struct State {
        Word u, wait;  // wait: remaining refractory steps
    };
    Word V_th, V_reset, ref;  // ref: refractory time t_ref, in steps

    template <class Values>
    FixedMembrane(const Values& value, double f_s, Constants& c)
        : V_th(c.level("V_th", value("V_th"))), V_reset(c.level("V_reset", value("V_reset"))), ref(c.count("ref", value("t_ref") * f_s)) {}
    void record(const State& s, Word* out) const { out[0] = s.u; }

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
struct FixedLifA : FixedMembrane {
    using Traits = LifATraits;
    double inertia;   // R_m C_m / T, where T = 1/f_s is the step
    Factor k_a, k_b;  // u[n] = k_a I[n] + k_b u[n-1] + k_c: backward Euler
    Word k_c, E_L;

    FixedLifA(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : FixedMembrane(value, f_s, c), inertia(value("R_m") * value("C_m") * f_s),
          k_a(c.factor("k_a", value("R_m") / uA_per_A / (1 + inertia))), k_b(c.factor("k_b", inertia / (1 + inertia))),
          k_c(c.level("k_c", value("E_L") / (1 + inertia))), E_L(c.level("E_L", value("E_L"))) {}

    State start() const { return {E_L, 0}; }
    NeuronStep step(State& s, Word I, Arithmetic& a) const {
        if (count_refractory_step(s.wait)) return {};
        s.u = a.saturate(a.times(k_a, I) + a.times(k_b, s.u) + k_c);
        return s.u > V_th ? fire(s.u, s.wait, V_th, a) : NeuronStep{};
    }
};

/// Alg. 4, LIF-B.
struct FixedLifB : FixedMembrane {
    using Traits = LifBTraits;
    Factor k;  // k_m = T / C_m, V per uA
    Word I_leak0, E_L;

    FixedLifB(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : FixedMembrane(value, f_s, c), k(c.factor("k_m", 1 / (value("C_m") * f_s * uA_per_A))),
          I_leak0(c.level("I_leak0", value("I_leak0") * uA_per_A)), E_L(c.level("E_L", value("E_L"))) {}

    State start() const { return {E_L, 0}; }
    NeuronStep step(State& s, Word I, Arithmetic& a) const {
        if (count_refractory_step(s.wait)) return {};
        s.u = a.saturate(s.u + a.times(k, a.saturate(I - I_leak0)));
        if (s.u > V_th) return fire(s.u, s.wait, V_th, a);
        s.u = std::max(s.u, E_L);
        return {};
    }
};

/// The neuron with an adaptive threshold V_th + a.
struct FixedAdaptive : FixedMembrane {
    using Traits = AdaptiveTraits;
    static constexpr Probe recordables[] = {{"u", "V"}, {"a", "V"}};
    struct State {
        Word u, a, wait;
    };
    Factor k, k_th;  // k_m = T / C_m, V per uA; decay factor of a in one step
    Word dV_th, E_L;

    FixedAdaptive(const ParameterValues<Traits>& value, double f_s, Constants& c)
        : FixedMembrane(value, f_s, c), k(c.factor("k_m", 1 / (value("C_m") * f_s * uA_per_A))),
          k_th(c.factor("k_th", num::exp(-1 / (value("tau_th") * f_s)))), dV_th(c.level("dV_th", value("dV_th"))),
          E_L(c.level("E_L", value("E_L"))) {}

    State start() const { return {E_L, 0, 0}; }
    void record(const State& s, Word* out) const { out[0] = s.u, out[1] = s.a; }
    NeuronStep step(State& s, Word I, Arithmetic& a) const {
        s.a = a.times(k_th, s.a);
        if (count_refractory_step(s.wait)) return {};
        s.u = std::max(a.saturate(s.u + a.times(k, I)), E_L);
        const Word theta = a.saturate(V_th + s.a);
        if (!(I > 0 && s.u > theta)) return {};
        const auto fired = fire(s.u, s.wait, theta, a);
        s.a = a.saturate(s.a + dV_th);
        return fired;
    }
};

}  // namespace corpuscle
