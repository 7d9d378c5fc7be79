#pragma once
// Groups the afferents that implement one afferent type: its model, its chip, another author's model.

#include <string>
#include <vector>

#include "model/catalog.hpp"

namespace corpuscle {

/// "sa1" for sa1, SA-I, sa1-circuit, sa1-kim and any circuits/sa1.cir or sa1_biased.cir. If the name does not begin
/// with the name of a known afferent, returns the complete name; for a netlist path, the file's stem.
std::string afferent_type_of(const AfferentPlan&);

/// Afferents of one type, by index. The first is the reference: the afferent with the name of the type, otherwise the first model,
/// otherwise the first requested.
struct ImplementationGroup {
    std::string afferent_type;
    std::vector<std::size_t> members;
};

/// All afferent types in the order of the request; many have only one implementation.
std::vector<ImplementationGroup> implementation_groups(std::span<const AfferentPlan>);

}  // namespace corpuscle
