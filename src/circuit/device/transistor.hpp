#pragma once

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// M: drain, gate, source, bulk, a model of level=80; its equations are uicm.hpp's.
Result<std::unique_ptr<Device>> make_transistor(const Element&, Setup&);
/// On the lanes of this machine's best instruction set; the answers are the same bits on all. Error: see instruction_set().
Result<std::unique_ptr<Bank>> make_transistor_bank();

}  // namespace corpuscle::circuit
