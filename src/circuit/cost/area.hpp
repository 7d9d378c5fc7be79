#pragma once
// Silicon area of elements.

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {

/// Areas in m^2, without wells, bulk contacts, wires, guard rings and pads.
struct Area {
    double gates = 0;       ///< channel area: m stack W L
    double arrays = 0;      ///< of transistors, with each array in the smallest rectangle that contains it
    double islands = 0;     ///< of the same transistors, with each unit transistor on its own island
    double capacitors = 0;  ///< of plates; they are metal above the transistors, so they may overlap the arrays
    double total() const { return arrays + capacitors; }
    Area& operator+=(const Area& more) {
        gates += more.gates, arrays += more.arrays, islands += more.islands, capacitors += more.capacitors;
        return *this;
    }
};

/// Density of MIM capacitors, F/m^2. 20 x 20 um are 0.8 pF and 30 x 30 um are 1.8 pF (thesis table 5; errata S4).
inline constexpr double capacitor_density = 2e-3;

/// Total area A_T of an array of equal unit transistors of W by L, in a rectangle of r rows (along W) and c columns (along L). The margins
/// around the array and between its units are inferred from the thesis's tables 10 and 13 (0.18 um):
///
///     A_T = (r W + (r - 1) 0.28 um + 0.5 um) (c L + (c - 1) 0.54 um + 0.96 um)
///
/// This is exact for these arrays of the thesis, given as r by c:
///
///     B1 2x1, B2 2x2, C1 1x1, C2 2x2, D1 1x2, D2 2x2, E 1x1, G1 to G3 1x8
///
/// For array A it is 3.6 % too large.
struct RectangleRule {
    static constexpr double around_W = 0.5e-6, around_L = 0.96e-6;  ///< m; margin of an island around its channel, both sides together
    static constexpr double between_W = 0.28e-6;                    ///< m; between units along W, which have separate diffusions
    static constexpr double between_L = 0.54e-6;                    ///< m; between units along L, which share a diffusion with contacts
};
/// A_T of an array with r = `rows` and c = `columns`, m^2.
inline double rectangle_area(double W, double L, double rows, double columns) {
    using Rule = RectangleRule;
    return (rows * W + (rows - 1) * Rule::between_W + Rule::around_W) * (columns * L + (columns - 1) * Rule::between_L + Rule::around_L);
}
/// The area, m^2, of the smallest rectangle that contains this number of unit transistors.
inline double array_area(double W, double L, double unit_transistors) {
    constexpr double max_rows = 4096;
    double smallest = rectangle_area(W, L, 1, std::ceil(unit_transistors));
    for (double rows = 2; rows <= std::min(std::ceil(unit_transistors), max_rows); ++rows)
        smallest = std::min(smallest, rectangle_area(W, L, rows, std::ceil(unit_transistors / rows)));
    return smallest;
}

}  // namespace corpuscle::circuit
