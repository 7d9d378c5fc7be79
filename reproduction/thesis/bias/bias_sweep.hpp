#pragma once
// Sweeps of the bias generator (circuits/bias.cir) over I_BIAS, supply voltage or temperature: the working range,
// and the quantities that limit it.
// Symbols. V_BN and V_BP are the body voltages that the generator sets, V_REF is half the supply, V_Q and I_Q are voltage and current of
// the replica, an inverter with its output tied to its input.

#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {

/// The swept quantity; the other two keep 200 nA, 0.7 V and 27 C unless the settings change them.
enum class BiasAxis { current, supply, temperature };

/// The working range is where the generator works: V_Q within 5 mV of half the supply and I_Q within a tenth of I_BIAS. Our definition, for
/// all three axes. For currents the thesis describes the range in words, too (BiasSweep::described_range).
constexpr double bias_voltage_margin = 5e-3, bias_current_margin = 0.1;  // V; fraction of I_BIAS
constexpr double described_V_BN[] = {0.1, 0.6};                          // V: E.2, over the generator's range of currents

struct BiasSweep {
    BiasAxis axis;
    std::vector<std::string> settings;
    NetlistResult netlist_result;

    /// Sweeps 10 nA to 3 uA, 0.4 to 0.9 V or -100 to 150 C.
    static Result<BiasSweep> run(BiasAxis, std::vector<std::string> settings = {});
    /// range: "10n 3u 2n", from 10 nA to 3 uA in steps of 2 nA.
    static Result<BiasSweep> run(BiasAxis, const std::string& range, std::vector<std::string> settings);

    StudyCurve curve(const std::string& name) const;  ///< "v(bn)"
    StudyCurve V_Q() const { return curve("v(q)"); }
    StudyCurve I_Q() const { return curve("i(vis)"); }
    /// Absolute errors of V_Q and I_Q over their margins: 1 is the limit of the working range.
    StudyCurve voltage_error() const;
    StudyCurve current_error() const;
    StudyCurve worst_error() const;  ///< the larger of the two

    /// The working range around the point of the smallest worst_error(), in units of the axis; NaN if no point is within the margins. If
    /// the range extends beyond the sweep, it is cut at the sweep's end.
    struct Range {
        double from, to;
        bool reaches_sweep_start, reaches_sweep_end;            ///< the range is limited by the sweep only
        double covered_fraction(double min, double max) const;  ///< fraction of the range [min, max] that this range covers
    };
    Range working_range() const;
    /// The range as E.2 describes it: V_BN is between 100 and 600 mV, and M3B and M4A are saturated. Only of a sweep over I_BIAS.
    Range described_range() const;
};

/// Intersection of two ranges.
BiasSweep::Range range_intersection(const BiasSweep::Range&, const BiasSweep::Range&);

/// An operating point of the generator: the quantities that can limit it.
struct BiasState {
    double V_Q, I_Q, V_BN, V_BP, V_REF;  // V, A
    double V_M3B, V_M4A;                 // V: drain-source voltages
    // V: saturation voltages phi_t (sqrt(1 + i_f) + 3), with the thermal voltage phi_t and the forward inversion level i_f. At this
    // drain-source voltage the reverse inversion level is about a hundredth of i_f (eq. 23).
    double V_sat_M3B, V_sat_M4A;
    double bulk_current;  // A: current from BN into the bulk junctions
    double I_BIAS;        // A

    std::string description() const;
};
/// Simulates the generator at rest with settings such as "i_bias=100n", "supply=0.8", "temp=95", "corner=ff", "vtn_shift=-35m".
Result<BiasState> simulate_bias_state(const std::vector<std::string>& settings);

/// The setting for a value on the axis: "supply=0.61".
std::string bias_setting(BiasAxis, double value);

}  // namespace corpuscle
