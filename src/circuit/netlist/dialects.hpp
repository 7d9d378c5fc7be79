#pragma once
// The simulator that a netlist was written for, forms whose meaning there differs, and files that are not netlists of SPICE. Used inside
// circuit/netlist only.

#include <string_view>

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

enum class Dialect { unknown, ltspice, xyce, hspice };

/// The simulator whose mark a netlist has: `.backanno` of LTspice, `.global_param` and `.options device` of Xyce, `.options runlvl` of
/// HSPICE.
Dialect recognise_dialect(const ParsedNetlist&);

/// Warns once for each form that means something else in the simulator that the netlist is written for. All forms are read as in ngspice.
void warn_about_dialect(ParsedNetlist&);

/// The remedy for a directive of another simulator that changes what is simulated, such as "; use .ac" for .sp. It may be "".
std::string_view remedy_for_missing(std::string_view directive);

/// True for a line whose first word is "simulator", as in "simulator lang=spectre" of Spectre.
bool is_simulator_line(std::string_view line);
/// Returns an error if a line shows that the file is written for Spectre or is a recording. `title`: the first line of the file, which in a
/// recording can be a row of numbers.
Result<void> refuse_other_language(const LogicalLine&, std::string_view title);
/// The same for a title, which may otherwise be any text: only a simulator line of Spectre is refused.
Result<void> refuse_title_of_other_language(const ParsedNetlist&);

}  // namespace corpuscle::circuit
