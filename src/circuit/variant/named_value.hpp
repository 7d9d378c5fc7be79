#pragma once
// The numbers of a circuit that a netlist override can set: their present values and units.

#include <optional>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// A .param of the top level, the value of a device, or one of its parameters.
struct NamedValue {
    double value = 0;
    std::string unit = {};       ///< "" if it has none, or if it is unknown, as for a .param
    std::string full_name = {};  ///< as in .set: "i_biasf", "xsummer.mn3b.m"
    bool is_parameter = false;   ///< true for a .param of the top level
    bool is_count = false;       ///< true for a number of devices: m= or stack=
};

/// The number that an override of this name sets; see apply_overrides(). Nothing if there is none, or if the name is ambiguous.
std::optional<NamedValue> find_named_value(const Circuit&, std::string_view name);

/// The parameter of an element with this name; "" is the element's value. Nothing if it cannot be set.
std::optional<NamedValue> named_value_of(const Element&, std::string_view parameter);

/// The unit of the numbers in which two circuits with the same elements differ; "" if they differ in numbers of several units, or in none
/// of known unit. If only a .param differs, this is its unit.
std::string unit_of_difference(const Circuit&, const Circuit&);

}  // namespace corpuscle::circuit
