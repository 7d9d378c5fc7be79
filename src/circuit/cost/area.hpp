#pragma once
// How much silicon an element takes.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// m^2. Wells, contacts to bulk, wires, guard rings and pads are in none of them.
struct Area {
    double gates = 0;       ///< of channels: m stack W L
    double arrays = 0;      ///< of transistors, each array in the rectangle that takes least
    double apart = 0;       ///< of the same, each unit on its own island
    double capacitors = 0;  ///< of plates; metal above transistors, so that some of it may lie over the arrays
    double total() const { return arrays + capacitors; }
    Area& operator+=(const Area&);
};

/// MIM capacitors, F/m^2: 20 x 20 um are 0.8 pF, 30 x 30 um 1.8 pF (thesis table 5; errata S4).
inline constexpr double capacitor_density = 2e-3;

/// Total area of an array of so many equal units of W by L, in rows and columns (along L) of one rectangle. What stands about it, and
/// between its units, is what the thesis's tables 10 and 13 have in common (0.18 um; inferred):
///     A_T = (r W + (r - 1) 0.28 um + 0.5 um) (c L + (c - 1) 0.54 um + 0.96 um)
/// exact for B1, B2, C1, C2, D1, D2 (r by c of 2x1, 2x2, 1x1, 2x2, 1x2, 2x2), E (1x1) and G1 to G3 (1x8); 3.6 % above A.
struct RectangleRule {
    static constexpr double around_W = 0.5e-6, around_L = 0.96e-6;     ///< m; of an island beyond its channel
    static constexpr double between_W = 0.28e-6, between_L = 0.54e-6;  ///< of two units: diffusions apart; a shared one with its contacts
};
double rectangle_area(double W, double L, double rows, double columns);
/// The least of the rectangles that hold so many units.
double array_area(double W, double L, double units);

/// Of a transistor or a capacitor; other elements have none that is known. Of a capacitor by formula neither.
Area area_of(const Element&);

}  // namespace corpuscle::circuit
