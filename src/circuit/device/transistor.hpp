#pragma once

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// The device of an M line: nodes drain, gate, source, bulk, and a model with level=80. The equations are in uicm.hpp.
Result<std::unique_ptr<Device>> make_transistor(const Element&, DeviceSetup&);
/// Transistors on SIMD lanes of the best instruction set of this machine. Results are bit-identical on all instruction sets. Errors: see
/// instruction_set().
Result<std::unique_ptr<DeviceBatch>> make_transistor_batch();

/// The constants of a transistor, with its variation applied. The reference is valid as long as the device.
struct UicmConstants;
const UicmConstants& transistor_constants(const Device&);

namespace lanes {
struct ChipKernels;
}
/// The kernels for blocks of chips, for the best instruction set of this machine.
Result<const lanes::ChipKernels*> chip_kernels();

}  // namespace corpuscle::circuit
