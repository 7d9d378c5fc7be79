#pragma once
// Leakage currents of transistors that are off, compared with the smallest bias current of the circuit.

#include <string>
#include <vector>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// Leakage of one transistor: the drain current, junction included, with the gate at the source and the supply voltage between drain
/// and source. The bulk is at the source, or as far forward-biased as at the operating point.
struct Leakage {
    std::size_t element = 0;  ///< index in Circuit::elements
    double current = 0;       ///< A
    /// V, at the operating point, positive towards conduction. The source is the terminal that acts as source there.
    double V_GS = 0;
    bool is_off = false;         ///< true if V_GS is below phi_t: the transistor carries less than e times its leakage current
    std::string capacitor_node;  ///< a node at its source or drain whose voltage a capacitor holds, such as "u"; "" if there is none
};

/// The leakage of every transistor at the operating point x. supply: V.
std::vector<Leakage> leakage_of(const System&, std::span<const double> x, double supply);

/// The smallest DC current above 0 of the ideal current sources, A, FORCE sources excluded; 0 if there is none.
double smallest_bias(const Circuit&);

}  // namespace corpuscle::circuit
