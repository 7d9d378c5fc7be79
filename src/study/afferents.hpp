#pragma once
// Afferents of every make by name: those of the catalogue, and netlists.

#include "model/catalog.hpp"

namespace corpuscle {

/// Whether the text can only be the path of a netlist: no part of the catalogue has a dot or a slash in its name.
inline bool names_netlist(std::string_view text) { return text.find_first_of("./") != std::string_view::npos; }

/// As plan_afferent; and "path/own.cir", a netlist with a force input and a spike output (doc/circuits.md).
Result<AfferentPlan> plan_any_afferent(std::string_view text, std::span<const Wish> wishes);

}  // namespace corpuscle
