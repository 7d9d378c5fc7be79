#pragma once
// Afferents of every make by name: those of the catalogue, and netlists.

#include "circuit/knobs.hpp"
#include "model/catalog.hpp"

namespace corpuscle {

/// Whether the text means a netlist: one that the program carries, or a path, for no part of the catalogue has a dot or a slash in its
/// name.
inline bool names_netlist(std::string_view text) {
    return circuit::carried_netlist(text) != nullptr || text.find_first_of("./") != std::string_view::npos;
}

/// What is asked of every netlist that takes part.
struct OfNetlists {
    std::vector<circuit::Knob> knobs = {};
    std::vector<std::string> traces = {};   ///< shown in place of what .save names, by those that have one of them
    mutable std::vector<bool> traced = {};  ///< of each: some netlist has it
    mutable std::string hint = {};          ///< what one that nobody has may have meant
    mutable bool used = false;
};

/// As plan_afferent; and netlists: "sa1-circuit", or "path/own.cir" with a force input and a spike output (doc/circuits.md). A wish for
/// one is a knob of it: "sa1-circuit.summer.N3B.w=1.2um".
Result<AfferentPlan> plan_any_afferent(std::string_view text, std::span<const Wish> wishes, const OfNetlists& = {});

/// Makes a copy of a netlist's plan as its values say that a spread has drawn; of another plan nothing.
Result<void> remake(AfferentPlan& copy, const AfferentPlan& original);

/// What of a wish's text goes on behind the netlist's name: "summer.N3B.w" of "sa1-circuit.summer.N3B.w=1.2um"; nothing if it is for
/// somebody else.
std::optional<std::string> knob_named(const Wish&, std::string_view netlist);

}  // namespace corpuscle
