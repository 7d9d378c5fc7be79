#pragma once
// The transistor as a subcircuit of expressions, for ngspice.

#include <string>

#include "circuit/device/uicm_card.hpp"

namespace corpuscle::circuit {

/// Functions that the subcircuits use.
std::string uicm_functions();

/// uicm_n or uicm_p; with a body effect uicm_n_body or uicm_p_body, which has five nodes more.
std::string uicm_subcircuit_name(bool pmos, bool has_body_effect);

/// The subcircuit ".subckt uicm_n d g s b ...".
std::string uicm_subcircuit(bool pmos, bool has_body_effect);

/// The parameters of one transistor at its temperature (degrees Celsius): "vt=0.4606 slope=1.27 ...".
std::string uicm_parameters(const UicmCard&, const UicmInstance&, double temperature, bool pmos);

}  // namespace corpuscle::circuit
