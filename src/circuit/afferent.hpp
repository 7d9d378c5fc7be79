#pragma once
// A netlist with a force input and a spike output, as an afferent.

#include "circuit/analysis/transient_plan.hpp"
#include "circuit/saved.hpp"
#include "circuit/spike_output.hpp"
#include "circuit/variants.hpp"
#include "circuit/within.hpp"
#include "signal/afferent.hpp"

namespace corpuscle::circuit {

/// Makes afferents from a netlist that was read and checked. The netlist must have a source that carries FORCE, and a .spike directive.
/// Of .tran only LONGEST and uic are used; other analyses are ignored. The copies are the chips of .mc, or of the mismatch override if
/// that is set; without either all copies are equal. The probes are the quantities that .save names, by default the .spike quantity.
class CircuitDesign final : public AfferentFactory, public std::enable_shared_from_this<CircuitDesign> {
public:
    static constexpr double longest_step = 5e-3;  ///< s, default of LONGEST of .tran

    static Result<std::shared_ptr<const CircuitDesign>> of(const Netlist&);
    static Result<std::shared_ptr<const CircuitDesign>> of(std::shared_ptr<const Circuit>);

    std::string_view kind() const override { return "netlist"; }
    std::string_view title() const override { return circuit->title; }
    std::vector<std::pair<std::string, std::string>> labels() const override;
    std::unique_ptr<Afferent> make(double dt, bool sampled, std::uint32_t copy = 0) const override;
    std::unique_ptr<Afferent> make(double dt, const std::optional<Draw>& chip) const;

    std::optional<Netlist> netlist;  ///< the source of the circuit, with its overrides
    std::shared_ptr<const Circuit> circuit;
    TransientPlan plan;
    TransientTimes times;
    SpikeOutput output;
    std::optional<Chips> chips;
    std::vector<Saved> shown;
    std::vector<Within> kept;
    std::uint64_t mark = 0;  ///< hash of all numbers of the circuit; identifies the netlist in saved states
};

}  // namespace corpuscle::circuit
