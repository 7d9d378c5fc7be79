#pragma once
// The variants of a netlist that .step and .mc define: the same circuit with other values.

#include <memory>
#include <optional>

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// One variant of a netlist.
struct Variant {
    std::string label;                       ///< "r=1000", "temp=85", "mc=17", separated by blanks; "" if there is only one variant
    std::shared_ptr<const Circuit> circuit;  ///< shared with the previous variant if only the chip differs
    std::optional<ChipSample> sample;
};

/// The chips that a .mc line requests.
struct ChipSpec {
    double count = 0;
    std::uint64_t seed = 0;
    bool has_process = true, has_mismatch = true;
    std::uint64_t first_chip = 0;  ///< number of the first chip

    ChipSample sample(std::uint64_t chip) const;  ///< the sample of chip number `first_chip` + `chip`
};
/// Reads a .mc line.
Result<ChipSpec> parse_chip_spec(const Directive&);
/// The sample of the circuit's chip; nothing if the circuit has no mismatch seed.
std::optional<ChipSample> chip_sample_of(const Circuit&);

/// All combinations of the values of .step with the chips of .mc:
///
///     .step param NAME FROM TO STEP | .step param NAME list A B ... | .step dec|oct param NAME FROM TO POINTS
///
///     .mc COUNT [seed=S] [process=0] [mismatch=0]
///
/// To step the temperature, write temp instead of param NAME. Several .step lines give all combinations of their values. Each chip has
/// a random process shift, and each of its transistors has a random delvto and mulu0. The standard deviations are in the model card (avt,
/// ais, svt0, sis).
class NetlistVariants {
public:
    /// The values of one .step line.
    struct Axis {
        std::string name;
        std::vector<double> values;
    };

private:
    Netlist netlist_;
    std::vector<Axis> axes_;
    ChipSpec chips_;
    std::shared_ptr<const Circuit> nominal_;
    struct StepResult {
        std::size_t number;
        std::string label;
        std::shared_ptr<const Circuit> circuit;
    };
    std::optional<StepResult> last_;

    Result<void> elaborate_step(std::size_t number);

public:
    static Result<NetlistVariants> create(const Netlist&);
    std::size_t count() const;
    const std::vector<Axis>& axes() const { return axes_; }
    const ChipSpec& chips() const { return chips_; }  ///< count is 0 if there is no .mc
    bool has_chips() const { return chips_.count > 0; }
    /// The variant of this number; the chip varies fastest. Consecutive numbers are cheap, since they share the circuit.
    Result<Variant> at(std::size_t number);
};

}  // namespace corpuscle::circuit
