#pragma once
// A netlist as a deck that ngspice runs and that gives what ours gives: for a second opinion, or for people who have ngspice.

#include <memory>
#include <string>
#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

struct NgspiceDeck {
    std::string text;
    std::vector<Error> left_out;  ///< what ngspice cannot be asked, by the netlist's lines; the deck's comments say so, too
};

/// The flat circuit, all parameters worked out, its transistors as subcircuits of formulas. Refuses what run() would refuse.
Result<NgspiceDeck> ngspice_deck(std::shared_ptr<const Circuit>);

}  // namespace corpuscle::circuit
