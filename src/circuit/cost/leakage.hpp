#pragma once
// What transistors let through when they are off, held against the smallest current that the circuit works with.

#include <string>
#include <vector>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// Of one transistor: its drain's current, A, junction and all, with gate at source and a supply's voltage between drain and source. Its
/// bulk is at its source, or as far forward of it as at the operating point.
struct Leak {
    std::size_t element = 0;  ///< in Circuit::elements
    double current = 0;
    double V_GS = 0;   ///< V, at the operating point, towards its own polarity, against the end that is its source there
    bool off = false;  ///< V_GS below phi_t: it carries less than e times what it leaks
    std::string onto;  ///< the node at its source or drain that a capacitor keeps, "u"; "" if none does
};

/// Every transistor, at an operating point.
std::vector<Leak> leaks_of(const System&, std::span<const double> x, double supply);

/// A: the smallest of the ideal current sources that carry no force; 0: there is none.
double smallest_bias(const Circuit&);

}  // namespace corpuscle::circuit
