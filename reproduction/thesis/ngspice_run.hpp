#pragma once
// Runs a netlist in ngspice, for studies that compare transistor models.

#include <map>

#include "circuit/export/ngspice_deck.hpp"

namespace corpuscle {

/// The measures (.meas) of an embedded netlist, such as "invb", with the transistors of a kit, by name. Fails without ngspice, and with its
/// message if it cannot run the deck.
Result<std::map<std::string, double>> measure_in_ngspice(const std::string& circuit, const circuit::Kit&);

}  // namespace corpuscle
