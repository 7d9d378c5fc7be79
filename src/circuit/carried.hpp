#pragma once
// The netlists that the program carries with it (signal/carried.hpp).

#include <string_view>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// An afferent's name for one of them.
struct Carried {
    std::string_view name, file;
};

/// To add one: its line here.
inline constexpr Carried carried_netlists[] = {
    {"sa1-circuit", "circuits/sa1.cir"},     {"fa1-circuit", "circuits/fa1.cir"},       {"sa1-macro", "circuits/sa1_macro.cir"},
    {"fa1-macro", "circuits/fa1_macro.cir"}, {"sa1-biased", "circuits/sa1_biased.cir"}, {"fa1-biased", "circuits/fa1_biased.cir"},
};

/// The one of this name, in any case; null: none.
const Carried* carried_netlist(std::string_view name);

/// The netlist of a name above, or of a path; `corner` as in Netlist::parse.
Result<Netlist> open_netlist(const std::string& name_or_path, const std::string& corner = "");

/// A netlist whose text includes files that are carried, by their paths as seen from `file`.
Result<Netlist> parse_carried(std::string text, std::string file, const std::string& corner = "");

}  // namespace corpuscle::circuit
