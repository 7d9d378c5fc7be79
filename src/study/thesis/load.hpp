#pragma once
// A transconductor whose output is tied to its input, read as the resistor that it is then.

#include "study/line.hpp"

namespace corpuscle {

struct Load {
    Line current, resistance;  ///< what flows into it, A, and dV/dI, ohm, over its voltage
    double rest = 0;           ///< V: nothing flows
    double most = 0, at = 0;   ///< the largest resistance, ohm, and where it is, V
    double from = 0, to = 0;   ///< V: between these it is within a share of the largest
};

/// Of the current into it over its voltage; straight where the resistance has lost less than this share of its largest.
Load load_of(Line current, double lost = 0.1);

}  // namespace corpuscle
