#pragma once
// The .model card of a bipolar transistor, SPICE's level 1 (Gummel and Poon).

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Parameters of a .model line; the rows in card.cpp describe them.
struct BipolarCard {
    double is = 1e-16, bf = 100, nf = 1, vaf = 0, ikf = 0, nkf = 0.5, ise = 0, ne = 1.5, br = 1, nr = 1, var = 0, ikr = 0, isc = 0, nc = 2;
    double rb = 0, irb = 0, rbm = 0, re = 0, rc = 0;
    double cje = 0, vje = 0.75, mje = 0.33, cjc = 0, vjc = 0.75, mjc = 0.33, xcjc = 1, cjs = 0, vjs = 0.75, mjs = 0, fc = 0.5;
    double tf = 0, xtf = 0, vtf = 0, itf = 0, ptf = 0, tr = 0;
    double iss = 0, ns = 1, ibe = 0, ibc = 0, kf = 0, af = 1;
    double xtb = 0, eg = 1.11, xti = 3, tnom = 27;
    bool is_pnp = false;
    bool is_lateral = false;  ///< the substrate forms a junction with the base; if false, with the collector
};

/// All names that a card may have.
std::vector<std::string_view> bipolar_parameter_names();
/// Parameters that other simulators have and that have no effect here.
std::span<const std::string_view> absent_bipolar_parameters();

/// Reads the card. Refuses levels other than 1, and parameters whose effect is not implemented.
Result<BipolarCard> read_bipolar_card(const Model&);

/// The card of a transistor of this area at its temperature. Currents and capacitances are multiplied by the area, resistances are divided
/// by it. Everything is converted from tnom to `kelvin` by the laws of SPICE (tlev = tlevc = 0 of ngspice). ibe and ibc are then the
/// saturation currents of the two junctions.
BipolarCard adjust_bipolar_card(BipolarCard, double area, double kelvin);

}  // namespace corpuscle::circuit
