#pragma once
// Exports a netlist as an ngspice deck that gives the same results, to check or to continue work in ngspice.

#include <memory>
#include <string>
#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// An exported netlist.
struct NgspiceDeck {
    std::string text;
    std::vector<Error>
        left_out;  ///< directives that ngspice does not have, at their lines of the netlist; comments of the deck list them too
};

/// The flat circuit with all parameters evaluated and transistors as subcircuits of expressions. Fails where run_directives() would fail.
Result<NgspiceDeck> ngspice_deck(std::shared_ptr<const Circuit>);

}  // namespace corpuscle::circuit
