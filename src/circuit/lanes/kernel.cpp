// Transistors, and chips, on SIMD lanes. Compiled once for each instruction set, CORPUSCLE_ISA; what is made here must not leave this file but
// for one table.

#include "circuit/lanes/chips_on.hpp"

namespace corpuscle::circuit::lanes::CORPUSCLE_ISA {
const TransistorLanes transistors = transistor_lanes<num::Lanes<double>>;
const ChipLanes chip_lanes = chip_lanes_of<num::Lanes<double>>;
}
