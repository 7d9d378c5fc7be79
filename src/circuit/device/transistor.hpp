#pragma once
// The MOS transistor as a netlist names it: M lines, and models of level 80, UICM.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_transistor(const Element&, Setup&);

}  // namespace corpuscle::circuit
