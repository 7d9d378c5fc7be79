#pragma once
// Directives of a netlist in ngspice's syntax.

#include <vector>

#include "circuit/export/export_names.hpp"

namespace corpuscle::circuit {

/// All directives as lines, with analyses first. Those that ngspice does not have become comments. Messages about these, and about results
/// that differ in ngspice, are appended to `left_out`.
std::string directives_text(const Circuit&, const ExportNames&, std::vector<Error>& left_out);

}  // namespace corpuscle::circuit
