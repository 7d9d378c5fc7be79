#pragma once
// The arrays of a netlist with UICM cards as transistors of a foundry's kit. Each distinct array becomes a subcircuit `d g s b`: a chain of
// units in series under one gate, each with the columns as its multiplier.

#include "circuit/export/element_text.hpp"
#include "circuit/export/kit_map.hpp"

namespace corpuscle::circuit {

/// A kit to export to: its map, with the devices that the user names, and its file.
struct Kit {
    KitMap map;
    std::string card;    ///< path of the kit's file as the deck has it
    std::string folder;  ///< its folder, "." for that of the deck
    std::string corner;  ///< of the netlist, in small letters; "": none is chosen
};

/// Collects the arrays of a circuit.
class KitArrays {
    const Circuit& circuit_;
    const Kit& kit_;
    std::map<std::string, std::string> names_;  // of the subcircuits, by their bodies
    std::string text_;

public:
    KitArrays(const Circuit& circuit, const Kit& kit) : circuit_(circuit), kit_(kit) {}

    /// The line of a transistor: an instance of its array. `head`: its name and nodes.
    Result<std::string> instance(const Element&, const std::string& head);
    /// The subcircuits of all arrays so far.
    const std::string& subcircuits() const { return text_; }

private:
    Result<std::string> body(const Element&) const;
    /// Size, columns, and what else each unit of the array has. `shift`: V, for the threshold; 0: none.
    Result<std::string> parameters(const Element&, const UicmInstance&, double shift) const;
    /// The units in series. `device`: its name and parameters. L_dif: m, length of a source or drain without given area.
    std::string chain(const UicmInstance&, double L_dif, const std::string& gate, const std::string& device) const;
    Result<KitDevice> role_of(const Model&) const;
    /// V, added to the magnitude of the threshold of the kit's device of `role`.
    Result<double> threshold_shift(const Element&, KitDevice role) const;
};

/// The lines of a deck before its transistors, which read the kit's files, and those after them.
struct KitLines {
    std::string before, after;
};
Result<KitLines> kit_lines(const Circuit&, const Kit&);

}  // namespace corpuscle::circuit
