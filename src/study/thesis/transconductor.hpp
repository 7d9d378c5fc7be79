#pragma once
// A transconductor's curve and what people read off it, for studies: current out of it over the voltage between its inputs.

#include "study/deck.hpp"

namespace corpuscle {

struct Transconductor {
    Line current;         ///< A, over the voltage between the inputs, V
    double middle = 0;    ///< V: where no current flows
    double g_m = 0;       ///< S, there; positive
    double most = 0;      ///< A, the largest current, of its two senses the smaller
    double straight = 0;  ///< V: half of the stretch about the middle in which the slope is within 5 % of g_m; at most all that is swept
    double power = 0;     ///< W, at the same voltage on both inputs
    double sense() const { return current.slope_at(middle) < 0 ? -1 : 1; }
};

/// Of a netlist whose `vplus` is swept about 0.35 V at 0.7 V, whose output's current is `out` and whose supply's is i(vi).
Result<Transconductor> transconductor_of(Deck, const std::string& out = "i(vout)");

/// A pair alone, `columns` by `stack` units of P, its tail `i_b` ideal and its two drains held: the difference of their currents.
Result<Transconductor> pair_alone(double i_b, int columns, int stack);

}  // namespace corpuscle
