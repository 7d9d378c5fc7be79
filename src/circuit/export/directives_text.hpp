#pragma once
// Directives of a netlist in ngspice's syntax.

#include <vector>

#include "circuit/export/export_names.hpp"

namespace corpuscle::circuit {

/// All directives as lines, with analyses first. Directives that ngspice does not have become comments. Appends to `warnings`: a message
/// for each of them, and for each directive whose results differ in ngspice.
std::string directives_text(const Circuit&, const ExportNames&, std::vector<Error>& warnings);

}  // namespace corpuscle::circuit
