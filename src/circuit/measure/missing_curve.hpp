#pragma once
// Tells a quantity that is not available in a plot from a misspelt name.

#include "circuit/netlist/netlist.hpp"
#include "circuit/output/point_sink.hpp"

namespace corpuscle::circuit {

/// If `name` is a quantity of nodes or elements that the circuit has, such as id(m1) or v(a) in a noise analysis, or an expression with
/// such a quantity, the part of `name` that is not available in the plot. Nothing if the plot has it, or if a name in it is unknown.
std::optional<std::string> unavailable_quantity(const Circuit&, const Plot&, std::string_view name);

}  // namespace corpuscle::circuit
