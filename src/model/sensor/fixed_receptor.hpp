#pragma once
// The thesis's receptors, Algorithms 1, 2, 5 and 6 as corrected, in fixed-point words: force in N, currents in uA. One step per conversion,
// f_s steps per second. F in a state is the force of the previous step. doc/fixed-point.md lists the algorithms line by line.

#include "model/parameter_values.hpp"
#include "model/receptor/fa1a.hpp"
#include "model/receptor/fa1b.hpp"
#include "model/receptor/sa1a.hpp"
#include "model/receptor/sa1b.hpp"
#include "model/sensor/fixed_point.hpp"

namespace corpuscle {

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

}  // namespace corpuscle
