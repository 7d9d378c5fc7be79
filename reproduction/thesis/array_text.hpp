#pragma once
// Transistor arrays as netlist lines: every unit transistor is a device of its own and every inner node is kept.

#include <string>
#include <string_view>

namespace corpuscle {

/// The model `plain`, which has only the equations of the thesis's appendix A: no length modulation, velocity saturation or junctions.
inline constexpr double simple_n = 1.27, simple_I_SQ = 112e-9, simple_V_T0 = 0.4606;  ///< slope factor; A; V: values in simple_card
inline constexpr std::string_view simple_card =
    ".model plain nmos(level=80 isq=112n vto=0.4606 n=1.27 sigmal=0 zetal=0 ve=1e30 js=0 jssw=0)\n"
    ".options gmin=0 reltol=1e-12 vntol=1e-14\n";
/// The typical cards of the process file, which the circuits use: nch, pch, nch018, ...
inline constexpr std::string_view process_card = ".lib '../process/tsmc180.lib' tt\n";

/// m columns of n unit transistors in series between drain and source, each column with its own inner nodes. `rest` follows the source
/// node in each line: "0 nch w=1.5u l=0.5u" (bulk, model, size).
std::string array_lines(const std::string& name, const std::string& drain, const std::string& gate, const std::string& source, int m, int n,
                        const std::string& rest);

}  // namespace corpuscle
