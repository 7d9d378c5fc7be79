#pragma once
// The lines of a deck from which ngspice starts its search for an operating point.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/export/element_text.hpp"

namespace corpuscle::circuit {

/// Lines of .ic or .nodeset, one for each node.
std::string node_voltages(std::string_view directive, const std::vector<std::pair<int, double>>& voltages, const ExportNames&);

/// Lines of .nodeset with our own operating point, which was found with the netlist's. The kit's is near, and without a start ngspice
/// searches for minutes, or fails. The netlist's own for a sweep, which may start elsewhere, and if no operating point is found.
std::string start_text(AnalysisContext&, const ExportNames&);

}  // namespace corpuscle::circuit
