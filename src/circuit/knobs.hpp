#pragma once
// Overrides of a netlist by name: its parameters, the values of its devices, corner, temperature and mismatch.

#include <span>

#include "circuit/carried.hpp"

namespace corpuscle::circuit {

/// An override NAME=VALUE, such as C_u=4pF. NAME is one of:
///  - corner, temp, mismatch;
///  - a .param of the top level;
///  - a device, which sets the value of R C L V I, the gain of E F G H, or the array of a transistor ("8x4" is 8 columns of 4 in series);
///  - a device and one of its parameters, "summer.N3B.w".
/// Letters may be of either case. The end of a device's path is enough, and SPICE's letters may be left out.
struct Knob {
    std::string name, value;
    std::string said;              ///< as the user wrote it: "--set sa1-circuit.C_u=4pF"
    bool parameter_alone = false;  ///< the name is never a device; for --supply
};

/// Opens the netlist of a name or path and applies the overrides; a later one wins over an earlier one.
Result<Netlist> tuned(const std::string& name_or_path, std::span<const Knob>);

/// The same for a netlist that `open` reads for a corner; errors call it `name`.
using NetlistOpener = std::function<Result<Netlist>(const std::string& corner)>;
Result<Netlist> tuned(const NetlistOpener& open, const std::string& name, std::span<const Knob>);

/// A number in SI and the unit that was written with it: "4pF" is {4e-12, "F"}. M is mega here, and m is milli.
struct Measured {
    double value;
    std::string_view unit;
};
Result<Measured> number_with_unit(std::string_view text);

}  // namespace corpuscle::circuit
