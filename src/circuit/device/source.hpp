#pragma once
// Independent sources, controlled sources, expression sources.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_voltage_source(const Element&, DeviceSetup&);
Result<std::unique_ptr<Device>> make_current_source(const Element&, DeviceSetup&);
Result<std::unique_ptr<Device>> make_controlled_source(const Element&, DeviceSetup&);  ///< E F G H
Result<std::unique_ptr<Device>> make_formula_source(const Element&, DeviceSetup&);     ///< B, and E and G with an expression

}  // namespace corpuscle::circuit
