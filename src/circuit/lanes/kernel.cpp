// Kernels for transistors and chips on SIMD lanes. Compiled once for each instruction set (CORPUSCLE_ISA). Only the two tables below may be
// used outside this file: all other code instantiated here contains instructions of that set.

#include "circuit/lanes/chips_on.hpp"

namespace corpuscle::circuit::lanes::CORPUSCLE_ISA {
const TransistorLanes transistors = transistor_kernels_for<num::Lanes<double>>;
const ChipLanes chip_lanes = chip_kernels_for<num::Lanes<double>>;
}  // namespace corpuscle::circuit::lanes::CORPUSCLE_ISA
