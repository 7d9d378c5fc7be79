#pragma once
// .set NAME=NUMBER ...: values of a netlist by name, as the option --set gives them. NAME is a .param of the top level, a device with its
// full path (xsummer.rload), or such a device and one of its parameters (xsummer.mn3b.m).

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// The overrides, and below them the values of the .set lines.
Result<ResolvedOverrides> add_set_lines(const ParsedNetlist&, const ResolvedOverrides&);
/// Checks, once the circuit is known, that each .set line names something that it has, with an allowed value.
Result<void> check_set_lines(const ParsedNetlist&, const Circuit&);

}  // namespace corpuscle::circuit
