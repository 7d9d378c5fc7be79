#pragma once
// A netlist with a force input and a spike output, as an afferent.

#include "circuit/analysis/transient_plan.hpp"
#include "circuit/saved.hpp"
#include "circuit/spike_output.hpp"
#include "circuit/variants.hpp"
#include "circuit/within.hpp"
#include "signal/afferent.hpp"

namespace corpuscle::circuit {

/// A netlist read and found fit: it has a source that carries FORCE and a .spike order. Of .tran count LONGEST and uic; other orders are
/// left alone. Its copies are the chips of its .mc, or of its mismatch if that is set, and alike without either. What is .save'd, else what
/// spikes are taken from, are its probes.
class CircuitDesign final : public Design, public std::enable_shared_from_this<CircuitDesign> {
public:
    static constexpr double longest_step = 5e-3;  ///< s, if .tran does not say

    static Result<std::shared_ptr<const CircuitDesign>> of(const Netlist&);
    static Result<std::shared_ptr<const CircuitDesign>> of(std::shared_ptr<const Circuit>);

    std::string_view kind() const override { return "netlist"; }
    std::string_view title() const override { return circuit->title; }
    std::vector<std::pair<std::string, std::string>> words() const override;
    std::unique_ptr<Afferent> make(double dt, bool sampled, std::uint32_t copy = 0) const override;
    std::unique_ptr<Afferent> make(double dt, const std::optional<Draw>& chip) const;

    std::optional<Netlist> netlist;  ///< it is of, with what is set of it
    std::shared_ptr<const Circuit> circuit;
    TransientPlan plan;
    TransientTimes times;
    SpikeOutput output;
    std::optional<Chips> chips;
    std::vector<Saved> shown;
    std::vector<Within> kept;
    std::uint64_t mark = 0;  ///< of all its numbers: another netlist has another
};

}  // namespace corpuscle::circuit
