#pragma once
// Resistor, capacitor, inductor.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_resistor(const Element&, DeviceSetup&);
Result<std::unique_ptr<Device>> make_capacitor(const Element&, DeviceSetup&);
Result<std::unique_ptr<Device>> make_inductor(const Element&, DeviceSetup&);

}  // namespace corpuscle::circuit
