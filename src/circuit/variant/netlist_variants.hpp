#pragma once
// The variants of a netlist that .step and .mc define: the same circuit with other values.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// One variant of a netlist.
struct Variant {
    std::string label;                       ///< such as "r=1000 temp=85 mc=17" (chips counted from 1); "" without .step and .mc
    std::shared_ptr<const Circuit> circuit;  ///< variants that differ only in their chip share one circuit, unless it has random values
    std::optional<ChipSample> sample;        ///< of the variant's chip; empty: nominal
};

/// The chips that a .mc line requests.
struct ChipSpec {
    double count = 0;  ///< number of chips
    std::uint64_t seed = 0;
    bool has_process = true, has_mismatch = true;  ///< the chips have random process shifts; their devices have random mismatch
    std::uint64_t first_chip = 0;                  ///< number of the first chip among all chips of this seed
    bool has_noise = false;                        ///< true if chips are sampled for the noise of their transients, which always differs

    ChipSample sample(std::uint64_t chip) const;  ///< the sample of chip number `first_chip` + `chip` of this seed
};
/// Reads a .mc line.
Result<ChipSpec> parse_chip_spec(const Directive&);
/// The sample of the chip that the mismatch override selects; nothing if the circuit has no mismatch seed.
std::optional<ChipSample> chip_sample_of(const Circuit&);

/// All combinations of the values of .step with the chips of .mc:
///
///     .step param NAME FROM TO STEP | .step param NAME list A B ... | .step dec|oct param NAME FROM TO POINTS
///
///     .mc COUNT [seed=S] [process=0] [mismatch=0]
///
/// POINTS is for each decade (dec) or octave (oct). To step the temperature, write temp instead of param NAME. Several .step lines give all
/// combinations of their values. Each chip has a random process shift, with the standard deviations svt0 and sis of the model card. Each of
/// its transistors has a random mismatch, with the coefficients avt and ais.
class NetlistVariants {
public:
    /// The values of one .step line.
    struct Axis {
        std::string name;
        std::vector<double> values;
    };

private:
    Netlist netlist_;
    std::vector<Axis> axes_;  // one for each .step line, in order
    ChipSpec chips_;
    std::shared_ptr<const Circuit> nominal_;  // the netlist's own parameter values
    /// The circuit of one combination of .step values.
    struct StepCircuit {
        std::size_t number;  // of the combination, from 0; the last .step line varies fastest
        std::string label;   // "r=1000 temp=85"
        Values parameters;   // of the .step lines
        std::optional<double> temperature;
        std::shared_ptr<const Circuit> circuit;
    };
    std::optional<StepCircuit> last_;  // the combination that was elaborated last

    /// Makes `last_` the combination of this number.
    Result<void> elaborate_step(std::size_t number);
    Result<std::shared_ptr<const Circuit>> elaborate_last(std::optional<RandomDraws>) const;
    Result<std::shared_ptr<const Circuit>> draw_chip(const ChipSample&) const;

public:
    static Result<NetlistVariants> create(const Netlist&);
    std::size_t count() const;  ///< number of variants, at least 1
    const std::vector<Axis>& axes() const { return axes_; }
    const ChipSpec& chips() const { return chips_; }  ///< count is 0 if there is no .mc
    bool has_chips() const { return chips_.count > 0; }
    /// The variant of this number, from 0 to count() - 1. The chip varies fastest, then the last .step line. A variant that differs from
    /// the previous one only in its chip is cheap, since it shares the circuit.
    Result<Variant> at(std::size_t number);
};

}  // namespace corpuscle::circuit
