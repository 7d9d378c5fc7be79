#pragma once

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// The device of an M line: nodes drain, gate, source, bulk, and a model with level=80. The equations are in uicm.hpp.
Result<std::unique_ptr<Device>> make_transistor(const Element&, DeviceSetup&);
/// Transistors on SIMD lanes of the instruction set that instruction_set() returns, with the same errors. Results are bit-identical on all
/// instruction sets.
Result<std::unique_ptr<DeviceBatch>> make_transistor_batch();

struct UicmConstants;
/// The constants of a device that make_transistor() has made, with its variation applied. The reference is valid as long as the device.
const UicmConstants& transistor_constants(const Device&);

namespace lanes {
struct ChipKernels;
}
/// The functions that compute one chip on each SIMD lane, for the instruction set that instruction_set() returns.
Result<const lanes::ChipKernels*> chip_kernels();

}  // namespace corpuscle::circuit
