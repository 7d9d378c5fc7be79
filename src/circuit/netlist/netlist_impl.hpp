#pragma once
// The implementation of Netlist. Used inside circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

struct Netlist::Impl : ParsedNetlist {};

}  // namespace corpuscle::circuit
