#pragma once
// A netlist with a force input and a spike output, as an afferent.

#include "circuit/analysis/transient_setup.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "core/afferent_factory.hpp"

namespace corpuscle::circuit {

/// Makes afferents from a netlist. The netlist must have a FORCE source and a .spike directive. The afferent uses LONGEST (the
/// maximum time step) and uic of .tran, and STEP and STOP as defaults of source waveforms. Other analyses are ignored. The probes are the
/// quantities that .save names, by default the .spike quantity.
///
/// Copies are counted from 1, and copy 0 is the nominal circuit. With .mc, copy k is the k-th chip. The mismatch override replaces .mc:
/// copies 0 and 1 are then the chip that it names, and further copies are the following chips. Without either, all copies are equal.
class CircuitAfferentFactory final : public AfferentFactory, public std::enable_shared_from_this<CircuitAfferentFactory> {
public:
    static constexpr double default_max_step = 5e-3;  ///< s, the default of LONGEST in .tran

    static Result<std::shared_ptr<const CircuitAfferentFactory>> create(const Netlist&);
    static Result<std::shared_ptr<const CircuitAfferentFactory>> create(std::shared_ptr<const Circuit>, std::optional<Netlist> = {});

    std::unique_ptr<Afferent> make(const AfferentPlan&, const SimulationOptions&) const override;
    AfferentTraits traits(const AfferentPlan&) const override;
    std::string composition(const AfferentPlan&) const override { return "netlist"; }
    std::vector<std::pair<std::string, std::string>> labels(const AfferentPlan&) const override;
    Result<std::shared_ptr<const AfferentFactory>> rebuilt(const AfferentPlan& copy, const AfferentPlan& original) const override;
    nlohmann::ordered_json cost(double rest_force, const EnergyUse& used) const override;
    Result<std::vector<SettableValue>> settable_values() const override;
    Result<std::string> schematic(std::string_view block) const override;

    /// Creates an afferent for a sample period of `dt` s. If `sampled`, spikes occur only at sample times. `copy` is the number of a copy
    /// with its own chip, counted from 1; 0 selects the nominal circuit.
    std::unique_ptr<Afferent> make(double dt, bool sampled, std::uint32_t copy = 0) const;
    /// An afferent of this chip (of the nominal circuit if `chip` is empty), with sample time dt (s) and exact spike times.
    std::unique_ptr<Afferent> make(double dt, const std::optional<ChipSample>& chip) const;

    std::optional<Netlist> netlist;  ///< the netlist of the circuit, with its overrides; empty if create() was given a Circuit
    std::shared_ptr<const Circuit> circuit;
    TransientPlan plan;    ///< its `stop` is not used
    TransientTimes times;  ///< from the last .tran; all 0 if there is no .tran
    SpikeOutput spike_output;
    std::optional<ChipSpec> chips;  ///< from .mc or the mismatch override; empty: all copies are nominal
    std::vector<SavedQuantity> probes;
    std::vector<OperatingRange> operating_ranges;
    std::uint64_t fingerprint = 0;  ///< hash of everything that determines the response; identifies the netlist in saved states
};

}  // namespace corpuscle::circuit
