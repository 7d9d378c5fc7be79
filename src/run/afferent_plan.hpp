#pragma once
// Finds afferents of every kind by name: entries of the catalogue and netlists.

#include "circuit/variant/netlist_overrides.hpp"
#include "model/catalog.hpp"

namespace corpuscle {

/// True if the text names a netlist: an embedded one or a path. Names of catalogue afferents contain neither a dot nor a slash.
inline bool names_netlist(std::string_view text) {
    return circuit::find_embedded_netlist(text) != nullptr || text.find_first_of("./") != std::string_view::npos;
}

/// Options for every netlist of a run.
struct NetlistOptions {
    std::vector<circuit::NetlistOverride> overrides = {};
    std::vector<std::string> probes = {};        ///< recorded instead of the .save quantities in each netlist that has at least one of them
    mutable std::vector<bool> probe_found = {};  ///< for each entry of `probes`: true if a netlist planned so far has it
    mutable std::string probe_hint = {};         ///< a similar name, for the first of `probes` that a netlist did not have
    mutable bool is_used = false;                ///< true once a netlist has been planned with these options
};

/// As plan_afferent, but also accepts netlists: "sa1-circuit", or "path/own.cir" with a force input and a spike output (doc/circuits.md).
/// An override for a netlist sets one of its values: "sa1-circuit.summer.N3B.w=1.2um".
Result<AfferentPlan> plan_any_afferent(std::string_view text, std::span<const ParameterOverride> overrides, const NetlistOptions& = {});

/// If the afferent is a netlist: rebuilds the circuit of a copy with the values that were sampled for the copy. `original` is the plan from
/// which the copy was made. Does nothing for other afferents.
Result<void> rebuild_copy(AfferentPlan& copy, const AfferentPlan& original);

/// The part of an override's name after the netlist's name: "summer.N3B.w" of "sa1-circuit.summer.N3B.w=1.2um". No value if the
/// override is not for this netlist.
std::optional<std::string> netlist_override_name(const ParameterOverride&, std::string_view netlist);

}  // namespace corpuscle
