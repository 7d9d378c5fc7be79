#pragma once
// A varistor: two terminals, a power law, a capacitance.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_varistor(const Element&, DeviceSetup&);

}  // namespace corpuscle::circuit
