#pragma once
// The members of a transistor that the batch of chips uses.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

struct UicmConstants;
/// The constants of a transistor, with its variation applied. The reference is valid as long as the device.
const UicmConstants& transistor_constants(const Device&);

namespace lanes {
struct ChipKernels;
}
/// The functions that compute one chip on each SIMD lane, for the instruction set that instruction_set() returns.
Result<const lanes::ChipKernels*> chip_kernels();

}  // namespace corpuscle::circuit
