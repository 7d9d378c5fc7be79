#pragma once
// Finds afferents of every kind by name: entries of the catalogue and netlists.

#include "circuit/variant/netlist_overrides.hpp"
#include "model/catalog.hpp"
#include "nir/nir_afferent.hpp"

namespace corpuscle {

/// True if the text names a netlist: an embedded one, or a path that is not that of a NIR file. Names of catalogue afferents contain neither
/// a dot nor a slash.
inline bool names_netlist(std::string_view text) {
    return circuit::find_embedded_netlist(text) != nullptr ||
           (text.find_first_of("./") != std::string_view::npos && !nir::names_graph(text));
}

/// Reads the text that specifies an afferent: as read_model_spec(), or a netlist, "sa1-circuit" or "path/own.cir" with a force input and a
/// spike output (doc/circuits.md), or a NIR file, "path/own.nir" (doc/nir.md).
Result<std::shared_ptr<const AfferentSpec>> read_afferent_spec(std::string_view text);

/// The plan of the afferent that a text specifies; see AfferentSpec. An override for a netlist sets one of its values:
/// "sa1-circuit.summer.N3B.w=1.2um"; one without a target is for every netlist.
Result<PlannedAfferent> plan_any_afferent(std::string_view text, std::span<const ParameterOverride> overrides = {},
                                          std::span<const std::string> probes = {});

}  // namespace corpuscle
