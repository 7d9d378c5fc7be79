#pragma once
// The UICM transistor as an ngspice subcircuit of expressions, and the parameters of one device for it.

#include <string>

#include "circuit/device/uicm_card.hpp"

namespace corpuscle::circuit {

/// Functions that the subcircuits uicm_n and uicm_p use.
std::string uicm_functions();

/// The subcircuit ".subckt uicm_n d g s b ..." or uicm_p.
std::string uicm_subcircuit(bool pmos);

/// The parameters of one transistor at its temperature (degrees Celsius): "vt=0.4606 slope=1.27 ...".
std::string uicm_parameters(const UicmCard&, const UicmInstance&, double temperature, bool pmos);

}  // namespace corpuscle::circuit
