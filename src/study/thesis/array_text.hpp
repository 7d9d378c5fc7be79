#pragma once
// Arrays as lines of a netlist, unit by unit with every inner node.

#include <string>
#include <string_view>

namespace corpuscle {

/// The thesis's model (app. A) and no more, as a card: without length modulation, velocity saturation or junctions.
inline constexpr double plain_n = 1.27, plain_I_SQ = 112e-9, plain_V_T0 = 0.4606;  ///< of the card's nch
inline constexpr std::string_view plain_card =
    ".model plain nmos(level=80 isq=112n vto=0.4606 n=1.27 sigmal=0 zetal=0 ve=1e30 js=0 jssw=0)\n"
    ".options gmin=0 reltol=1e-12 vntol=1e-14\n";
/// The circuits' own cards.
inline constexpr std::string_view whole_card = ".lib '../process/tsmc180.lib' tt\n";

/// m columns of n units between drain and source, each column with inner nodes of its own; `rest` follows the source: "b nch w=1.5u
/// l=0.5u".
std::string units_text(const std::string& name, const std::string& drain, const std::string& gate, const std::string& source, int m, int n,
                       const std::string& rest);

}  // namespace corpuscle
