#pragma once
// Overrides of a netlist by name: its parameters, the values of its devices, corner, temperature and mismatch.

#include <span>

#include "circuit/variant/embedded_netlists.hpp"

namespace corpuscle::circuit {

/// An override NAME=VALUE, such as C_u=4pF. NAME is one of:
///
///  - corner, temp, mismatch
///
///  - a .param of the top level
///
///  - a device: sets the value of R C L, the DC value of V I, the gain of E F G H, or the array of a transistor ("8x4" is 8 columns of 4
///    elements in series)
///
///  - a device and one of its parameters, "summer.N3B.w"
///
/// Case is ignored. The end of a device's path is enough. The first letter of a device or subcircuit, which tells SPICE its kind, may be
/// left out: summer.N3B is xsummer.mn3b.
struct NetlistOverride {
    std::string name, value;
    std::string text;                ///< as the user wrote it: "--set sa1-circuit.C_u=4pF"
    bool is_parameter_only = false;  ///< the name must not be that of a device; for --supply
};

/// Opens the netlist of a name or path and applies the overrides. If two set the same value, the later one wins.
Result<Netlist> apply_overrides(const std::string& name_or_path, std::span<const NetlistOverride>);

/// The same for a netlist that `open` reads with a given corner ("" if no override sets one). Error messages call the netlist `name`.
using NetlistOpener = std::function<Result<Netlist>(const std::string& corner)>;
Result<Netlist> apply_overrides(const NetlistOpener& open, const std::string& name, std::span<const NetlistOverride>);

/// A number in SI units and the unit that was written with it ("" if none): "4pF" is {4e-12, "F"}. Unlike in SPICE, M is mega.
struct NumberWithUnit {
    double value;
    std::string_view unit;
};
Result<NumberWithUnit> parse_number_with_unit(std::string_view text);

}  // namespace corpuscle::circuit
