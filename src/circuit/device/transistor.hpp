#pragma once

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// M: drain, gate, source, bulk, a model of level=80; its equations are uicm.hpp's.
Result<std::unique_ptr<Device>> make_transistor(const Element&, Setup&);
/// On the lanes of this machine's best instruction set; the answers are the same bits on all. Error: see instruction_set().
Result<std::unique_ptr<Bank>> make_transistor_bank();

/// The numbers of a transistor as it is drawn now; they live where it does.
struct UicmConstants;
const UicmConstants& transistor_constants(const Device&);

namespace lanes {
struct ChipLanes;
}
/// The kernels for many chips, of this machine's best instruction set.
Result<const lanes::ChipLanes*> chip_kernels();

}  // namespace corpuscle::circuit
