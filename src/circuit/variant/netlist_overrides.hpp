#pragma once
// The netlists that are embedded in the program, and overrides of a netlist by name: its parameters, the values of its devices, corner,
// temperature and mismatch.

#include "circuit/netlist/netlist.hpp"
#include "core/parameter_override.hpp"

namespace corpuscle::circuit {

/// The name of an afferent, and the path of its netlist among the files that are embedded in the program.
struct EmbeddedNetlist {
    std::string_view name, file;
};

/// All embedded netlists. To add one, add a line here.
inline constexpr EmbeddedNetlist embedded_netlists[] = {
    {"sa1-circuit", "circuits/sa1.cir"},     {"fa1-circuit", "circuits/fa1.cir"},       {"sa1-macro", "circuits/sa1_macro.cir"},
    {"fa1-macro", "circuits/fa1_macro.cir"}, {"sa1-biased", "circuits/sa1_biased.cir"}, {"fa1-biased", "circuits/fa1_biased.cir"},
};

/// The embedded netlist of the afferent of this name, ignoring case; null if there is none.
const EmbeddedNetlist* find_embedded_netlist(std::string_view name);

/// Reads the embedded netlist of this name. If there is none, reads the file at this path. For `corner`, see Netlist::parse().
Result<Netlist> open_netlist(const std::string& name_or_path, const std::string& corner = "");

/// Parses a netlist whose included files are embedded; their paths are relative to `file`.
Result<Netlist> parse_embedded(std::string text, std::string file, const std::string& corner = "");

/// The override of a netlist that "C_u=4pF" or "summer.N3B=8x4" means. `option`: the option of the command line that has this text,
/// "--set".
Result<ParameterOverride> parse_netlist_override(const std::string& netlist, const std::string& text, std::string_view option = "");

/// Opens the netlist of a name or path and applies the overrides that are for it: those whose name begins with the netlist's name or path
/// ("sa1-circuit.C_u"), and those without a target. If two set the same value, the later one wins. The rest of the name is one of:
///
///  - corner, temp, mismatch
///
///  - a .param of the top level
///
///  - a number of .options, such as reltol or noisefmax
///
///  - a device: sets the value of R C L, the DC value of V I, the gain of E F G H, or the array of a transistor ("8x4" is 8 columns of 4
///    elements in series); not in an override without a target
///
///  - a device and one of its parameters, "summer.N3B.w"; not in an override without a target
///
/// Case is ignored. The end of a device's path is enough. The first letter of a device or subcircuit, which tells SPICE its kind, may be
/// left out: summer.N3B is xsummer.mn3b.
Result<Applied<Netlist>> apply_overrides(const std::string& name_or_path, std::span<const ParameterOverride>);

/// The same for a netlist that `open` reads with a given corner ("" if no override sets one). Error messages call the netlist `name`.
using NetlistOpener = std::function<Result<Netlist>(const std::string& corner)>;
Result<Applied<Netlist>> apply_overrides(const NetlistOpener& open, const std::string& name, std::span<const ParameterOverride>);

/// A number in SI units and the unit that was written with it ("" if none): "4pF" is {4e-12, "F"}. Unlike in SPICE, M is mega.
struct NumberWithUnit {
    double value;
    std::string_view unit;
};
Result<NumberWithUnit> parse_number_with_unit(std::string_view text);

}  // namespace corpuscle::circuit
