#pragma once
// .within: the operating range of a circuit.

#include "circuit/saved.hpp"
#include "signal/afferent.hpp"

namespace corpuscle::circuit {

/// .within v(NODE[,NODE]) LOW HIGH ["MESSAGE"]: the range of a voltage, or of a current i(V), in which the circuit works as designed.
/// Violations are reported; the simulation continues.
struct Within {
    Saved what;
    double low, high;
    std::string sentence;  ///< explains a violation; may be ""
    SourceLocation place;

    ValidRange range() const { return {what.name, what.is_voltage() ? "V" : "A", low, high, sentence}; }
    bool holds(double x) const { return x >= low && x <= high; }
};
Result<std::vector<Within>> within_of(const System&);

}  // namespace corpuscle::circuit
