#pragma once
// What a Netlist holds. Inside circuit/netlist only.

#include "circuit/netlist/body.hpp"

namespace corpuscle::circuit {

struct Netlist::Parsed : ParsedNetlist {};

}  // namespace corpuscle::circuit
