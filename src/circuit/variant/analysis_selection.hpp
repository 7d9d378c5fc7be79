#pragma once
// Selects one analysis of a circuit, or runs another one instead of those of the netlist.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// An analysis to run.
struct AnalysisSelection {
    std::string name;                     ///< "tran"
    std::vector<std::string> words = {};  ///< of its directive: "1m", "1"; empty: as in the netlist
};

/// The circuit with no other analyses, and without the outputs of others (.meas, .print, .four). It has no .expect, which holds for the
/// complete netlist. Without words, each directive of this analysis is kept; a circuit without one is an error, except for .op.
Result<Circuit> select_analysis(const Circuit&, const AnalysisSelection&);

}  // namespace corpuscle::circuit
