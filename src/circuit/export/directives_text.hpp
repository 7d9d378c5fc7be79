#pragma once
// Directives of a netlist in ngspice's syntax.

#include <vector>

#include "circuit/export/export_names.hpp"

namespace corpuscle::circuit {

/// All directives as lines. Those that ngspice does not have become comments and are appended to `left_out`.
std::string directives_text(const Circuit&, const ExportNames&, std::vector<Error>& left_out);

}  // namespace corpuscle::circuit
