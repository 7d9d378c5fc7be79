#pragma once
// Groups the afferents that are versions of one receptor: its model, its chip, another author's model.

#include <string>
#include <vector>

#include "model/catalog.hpp"

namespace corpuscle {

/// "sa1" for sa1, SA-I, sa1-circuit, sa1-kim and any circuits/sa1.cir or sa1_biased.cir. If the name does not begin
/// with the name of a known afferent, returns the complete name; for a netlist path, the file's stem.
std::string receptor_of(const AfferentPlan&);

/// Afferents of one receptor, by index. The first is the reference: the afferent with the receptor's own name, otherwise the first model,
/// otherwise the first requested.
struct VersionGroup {
    std::string receptor;
    std::vector<std::size_t> members;
};

/// All receptors in the order of the request; many have only one version.
std::vector<VersionGroup> version_groups(std::span<const AfferentPlan>);

}  // namespace corpuscle
