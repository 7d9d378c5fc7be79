#pragma once
// What people set of a netlist, by name: its parameters, its devices' numbers, corner, temperature, mismatch; and what they want to see.

#include <span>

#include "circuit/carried.hpp"

namespace corpuscle::circuit {

/// "C_u" is to be "4pF". NAME is `corner`, `temp`, `mismatch`; else a .param of the top level; else a device (an array "8x4": 8 columns of
/// 4 units; of R C L V I and the gains of E F G H their value); else a device and one of its numbers, "summer.N3B.w". Letters of either
/// case; of a device's path the end is enough and SPICE's letters may be left out.
struct Knob {
    std::string name, value;
    std::string said;              ///< as it was asked for: "--set sa1-circuit.C_u=4pF"
    bool parameter_alone = false;  ///< not a device: --supply
};

/// The netlist of a name or path with the knobs set; a later one goes before an earlier one.
Result<Netlist> tuned(const std::string& name_or_path, std::span<const Knob>);

/// The same of a netlist that `open` reads for a corner; `name` is what errors call it.
using NetlistOpener = std::function<Result<Netlist>(const std::string& corner)>;
Result<Netlist> tuned(const NetlistOpener& open, const std::string& name, std::span<const Knob>);

/// A number with the unit that people gave it, in SI: "4pF" is {4e-12, "F"}. M is mega here, and m milli.
struct Measured {
    double value;
    std::string_view unit;
};
Result<Measured> number_with_unit(std::string_view text);

}  // namespace corpuscle::circuit
