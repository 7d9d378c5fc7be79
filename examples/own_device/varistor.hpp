#pragma once
// A varistor with two terminals: its current is a power of the voltage, and it has a capacitance.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_varistor(const Element&, DeviceSetup&);

}  // namespace corpuscle::circuit
