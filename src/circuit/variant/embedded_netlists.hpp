#pragma once
// The netlists that are embedded in the program.

#include <string_view>

#include "circuit/netlist/netlist.hpp"

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

}  // namespace corpuscle::circuit
