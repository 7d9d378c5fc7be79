#pragma once
// The netlists that are embedded in the program.

#include <string_view>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// The name of an afferent, and the embedded netlist that describes it.
struct EmbeddedNetlist {
    std::string_view name, file;
};

/// To add one, add its line here.
inline constexpr EmbeddedNetlist embedded_netlists[] = {
    {"sa1-circuit", "circuits/sa1.cir"},     {"fa1-circuit", "circuits/fa1.cir"},       {"sa1-macro", "circuits/sa1_macro.cir"},
    {"fa1-macro", "circuits/fa1_macro.cir"}, {"sa1-biased", "circuits/sa1_biased.cir"}, {"fa1-biased", "circuits/fa1_biased.cir"},
};

/// The entry of this name in upper or lower case; null if there is none.
const EmbeddedNetlist* find_embedded_netlist(std::string_view name);

/// Reads the embedded netlist of this name, or else the file at this path; `corner` as in Netlist::parse.
Result<Netlist> open_netlist(const std::string& name_or_path, const std::string& corner = "");

/// Parses a netlist whose included files are embedded; their paths are relative to `file`.
Result<Netlist> parse_embedded(std::string text, std::string file, const std::string& corner = "");

}  // namespace corpuscle::circuit
