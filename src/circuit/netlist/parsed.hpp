#pragma once
// The implementation of Netlist. Used inside circuit/netlist only.

#include "circuit/netlist/body.hpp"

namespace corpuscle::circuit {

struct Netlist::Parsed : ParsedNetlist {};

}  // namespace corpuscle::circuit
