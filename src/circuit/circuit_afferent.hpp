#pragma once
// A netlist with a force input and a spike output, as an afferent.

#include "circuit/analysis/transient_plan.hpp"
#include "circuit/netlist_variants.hpp"
#include "circuit/operating_range.hpp"
#include "circuit/saved_quantities.hpp"
#include "circuit/spike_output.hpp"
#include "signal/afferent.hpp"

namespace corpuscle::circuit {

/// Makes afferents from a netlist that was read and checked. The netlist must have a FORCE source and a .spike directive. Only LONGEST
/// and uic of .tran are used, and other analyses are ignored. The copies are the chips of .mc, or of the mismatch override if that is
/// set; without either, all copies are equal. The probes are the quantities that .save names, by default the .spike quantity.
class CircuitAfferentFactory final : public AfferentFactory, public std::enable_shared_from_this<CircuitAfferentFactory> {
public:
    static constexpr double default_max_step = 5e-3;  ///< s, default of LONGEST in .tran

    static Result<std::shared_ptr<const CircuitAfferentFactory>> create(const Netlist&);
    static Result<std::shared_ptr<const CircuitAfferentFactory>> create(std::shared_ptr<const Circuit>);

    std::string_view kind() const override { return "netlist"; }
    std::string_view title() const override { return circuit->title; }
    std::vector<std::pair<std::string, std::string>> labels() const override;
    std::unique_ptr<Afferent> make(double dt, bool sampled, std::uint32_t copy = 0) const override;
    /// The afferent of one chip, or of the nominal circuit, with sample time dt (s).
    std::unique_ptr<Afferent> make(double dt, const std::optional<ChipSample>& chip) const;

    std::optional<Netlist> netlist;  ///< the source of the circuit, with its overrides
    std::shared_ptr<const Circuit> circuit;
    TransientPlan plan;
    TransientTimes times;
    SpikeOutput spike_output;
    std::optional<ChipSpec> chips;
    std::vector<SavedQuantity> probes;
    std::vector<OperatingRange> operating_ranges;
    std::uint64_t fingerprint = 0;  ///< hash of everything that determines the response; identifies the netlist in saved states
};

}  // namespace corpuscle::circuit
