#pragma once
// The bias generator (circuits/bias.cir) along its current, its supply or its temperature: where it works, and what stops it.

#include "study/deck.hpp"

namespace corpuscle {

/// What is swept; the other two stand at 200 nA, 0.7 V and 27 C, or where the settings put them.
enum class BiasAxis { current, supply, temperature };

/// It works where V_Q is within 5 mV of half the supply and I_Q within a tenth of I_BIAS: our words, the thesis has none.
constexpr double bias_voltage_margin = 5e-3, bias_current_margin = 0.1;  // V, of I_BIAS

struct BiasSweep {
    BiasAxis axis;
    std::vector<std::string> settings;
    Found found;

    static Result<BiasSweep> along(BiasAxis, std::vector<std::string> settings = {});
    static Result<BiasSweep> along(BiasAxis, const std::string& range, std::vector<std::string> settings);  ///< "10n 3u 2n"

    Line line(const std::string& name) const;  ///< "v(bn)"
    Line V_Q() const { return line("v(q)"); }
    Line I_Q() const { return line("i(vis)"); }
    /// How far V_Q and I_Q are off, in margins: 1 is just good enough.
    Line miss_of_voltage() const;
    Line miss_of_current() const;
    Line miss() const;  ///< of the worse one

    /// Between which values it works, about the one at which it is best; an end that is not within the sweep is the sweep's.
    struct Range {
        double from, to;
        bool open_below, open_above;                       ///< it works to the sweep's end
        double share_of(double least, double most) const;  ///< what part of another range it covers
    };
    Range works() const;
};

/// Both ranges' common part.
BiasSweep::Range common(const BiasSweep::Range&, const BiasSweep::Range&);

/// The generator somewhere: what could stop it.
struct BiasState {
    double V_Q, I_Q, V_BN, V_BP, V_REF;  // V, A
    double V_M3B, V_M4A;                 // V: drain to source
    double needs_M3B, needs_M4A;         // V, to be saturated: phi_t (sqrt(1 + i_f) + 3), eq. 23 where i_r is a hundredth or so of i_f
    double bulks;                        // A: what flows from BN into the bulks' junctions
    double asked;                        // A: I_BIAS

    std::string words() const;
};
/// Settings "i_bias=100n", "supply=0.8", "temp=95", "corner=ff", "vtn_shift=-35m".
Result<BiasState> bias_state(const std::vector<std::string>& settings);

/// What is set to be at a place of the axis: "supply=0.61".
std::string bias_setting(BiasAxis, double value);

}  // namespace corpuscle
