#pragma once
// Groups the afferents of a run by afferent type: the model of a type, its circuit and the models of other authors are in one group.

#include <string>
#include <vector>

#include "model/catalog.hpp"

namespace corpuscle {

/// The afferent type of a plan, from its name: "sa1" for sa1, SA-I, sa1-circuit, sa1-kim, and for paths such as circuits/sa1.cir or
/// sa1_biased.cir. If the name does not begin with the name of a catalogue afferent, returns the complete name; for the path of a netlist,
/// the file name without directory and extension.
std::string afferent_type_of(const AfferentPlan&);

/// The plans of one afferent type. The first is the reference: the afferent with the name of the type, otherwise the first model, otherwise
/// the first netlist.
struct ImplementationGroup {
    std::string afferent_type;
    std::vector<std::size_t> members;  ///< indexes of plans
};

/// One group for each afferent type, in the order in which the types first occur. A group may have a single member.
std::vector<ImplementationGroup> implementation_groups(std::span<const AfferentPlan>);

}  // namespace corpuscle
