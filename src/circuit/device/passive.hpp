#pragma once
// Resistor, capacitor, inductor.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_resistor(const Element&, Setup&);
Result<std::unique_ptr<Device>> make_capacitor(const Element&, Setup&);
Result<std::unique_ptr<Device>> make_inductor(const Element&, Setup&);

}  // namespace corpuscle::circuit
