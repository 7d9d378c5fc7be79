#pragma once
// Which afferents are versions of one receptor: its model, its chip, another's model of it.

#include <string>
#include <vector>

#include "model/catalog.hpp"

namespace corpuscle {

/// "sa1" of sa1, SA-I, sa1-circuit, sa1-kim and any circuits/sa1.cir or sa1_biased.cir. Of a name that begins with no named afferent's,
/// the whole of it; of a netlist the file's stem.
std::string receptor_of(const AfferentPlan&);

/// Afferents of one receptor, by number. The first is what the others are held against: the receptor's own name, else a model, else
/// who was asked for first.
struct Versions {
    std::string receptor;
    std::vector<std::size_t> members;
};

/// All receptors in the order they were asked for; many have one version only.
std::vector<Versions> versions_of(std::span<const AfferentPlan>);

}  // namespace corpuscle
