#pragma once
// A device whose current, voltage or charge is an expression (B, and C, E, G with an expression).

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

enum class ExpressionQuantity { current, voltage, charge };

/// Makes the device of an element with an expression. A current and a charge are multiplied by the value m of the element.
Result<std::unique_ptr<Device>> make_expression_device(const Element&, DeviceSetup&, ExpressionQuantity);

}  // namespace corpuscle::circuit
