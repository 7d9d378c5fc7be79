#pragma once
// Exports a netlist as an ngspice deck that gives the same results, to check or to continue work in ngspice.

#include "circuit/export/kit_arrays.hpp"

namespace corpuscle::circuit {

/// An exported netlist.
struct NgspiceDeck {
    std::string text;
    /// Messages about directives that ngspice does not have, or whose results differ, with their lines of the netlist. Comments in the deck
    /// say the same.
    std::vector<Error> warnings;
};

/// The flat circuit with all parameters evaluated. UICM transistors are subcircuits of expressions, or with a kit its transistors. Fails
/// where run_directives() would fail.
Result<NgspiceDeck> ngspice_deck(std::shared_ptr<const Circuit>, const Kit* kit = nullptr);

}  // namespace corpuscle::circuit
