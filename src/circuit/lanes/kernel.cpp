// Kernels for transistors and chips on SIMD lanes. Compiled once for each instruction set (CORPUSCLE_ISA). Only the three tables below may
// be used outside this file: all other code instantiated here contains instructions of that set.

#include "circuit/lanes/chip_kernels_impl.hpp"
#include "circuit/lanes/front_kernels_impl.hpp"

namespace corpuscle::circuit::lanes::CORPUSCLE_ISA {
const TransistorKernels transistor_kernel_table = transistor_kernels_for<num::Lanes<double>>;
const ChipKernels chip_kernel_table = chip_kernels_for<num::Lanes<double>>;
const FrontKernels front_kernel_table = front_kernels_for<num::Lanes<double>>;
}  // namespace corpuscle::circuit::lanes::CORPUSCLE_ISA
