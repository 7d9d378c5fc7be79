#pragma once
// What a netlist asks for, as ngspice wants it asked; what cannot be asked there, and why.

#include <vector>

#include "circuit/export/names.hpp"

namespace corpuscle::circuit {

/// All commands as lines; those that ngspice has no word for as comments, which stand in `left_out`, too.
std::string orders_text(const Circuit&, const ExportNames&, std::vector<Error>& left_out);

}  // namespace corpuscle::circuit
