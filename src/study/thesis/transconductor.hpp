#pragma once
// The current of a transconductor over its differential input voltage, and the figures of merit read from it.

#include "study/deck.hpp"

namespace corpuscle {

struct Transconductor {
    Line current;         ///< A, over the differential input voltage, V
    double middle = 0;    ///< V: input at which the current is zero
    double g_m = 0;       ///< S, at that input; positive
    double most = 0;      ///< A, the largest current; the smaller of the two signs
    double straight = 0;  ///< V: half the width of the range about the middle in which the slope is within 5 % of g_m; at most the sweep
    double power = 0;     ///< W, with equal inputs
    double sense() const { return current.slope_at(middle) < 0 ? -1 : 1; }
};

/// Sweeps the source `vplus` of a netlist about 0.35 V at a supply of 0.7 V. `out` is the output current; i(vi) is the supply current.
Result<Transconductor> transconductor_of(Deck, const std::string& out = "i(vout)");

/// A differential pair without its load: `columns` by `stack` unit transistors (P), an ideal tail current `i_b`, both drains held. The
/// current is the difference of the drain currents.
Result<Transconductor> pair_alone(double i_b, int columns, int stack);

}  // namespace corpuscle
