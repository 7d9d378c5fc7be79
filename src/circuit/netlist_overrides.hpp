#pragma once
// Overrides of a netlist by name: its parameters, the values of its devices, corner, temperature and mismatch.

#include <span>

#include "circuit/embedded_netlists.hpp"

namespace corpuscle::circuit {

/// An override NAME=VALUE, such as C_u=4pF. NAME is one of:
///
///  - corner, temp, mismatch
///
///  - a .param of the top level
///
///  - a device: sets the value of R C L V I, the gain of E F G H, or the array of a transistor ("8x4" is 8 columns of 4 in series)
///
///  - a device and one of its parameters, "summer.N3B.w"
///
/// Letters may be of either case. The end of a device's path is enough. The first letter, which tells SPICE the kind of device, may be
/// left out.
struct NetlistOverride {
    std::string name, value;
    std::string text;                ///< as the user wrote it: "--set sa1-circuit.C_u=4pF"
    bool is_parameter_only = false;  ///< the name is never a device; for --supply
};

/// Opens the netlist of a name or path and applies the overrides; a later one wins over an earlier one.
Result<Netlist> apply_overrides(const std::string& name_or_path, std::span<const NetlistOverride>);

/// The same for a netlist that `open` reads for a corner; errors call it `name`.
using NetlistOpener = std::function<Result<Netlist>(const std::string& corner)>;
Result<Netlist> apply_overrides(const NetlistOpener& open, const std::string& name, std::span<const NetlistOverride>);

/// A number in SI units and the unit that was written with it: "4pF" is {4e-12, "F"}. Unlike in SPICE, M is mega and m is milli.
struct NumberWithUnit {
    double value;
    std::string_view unit;
};
Result<NumberWithUnit> parse_number_with_unit(std::string_view text);

}  // namespace corpuscle::circuit
