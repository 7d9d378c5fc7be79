#pragma once
// .within: where a circuit works as it was designed.

#include "circuit/saved.hpp"
#include "signal/afferent.hpp"

namespace corpuscle::circuit {

/// .within v(NODE[,NODE]) LOW HIGH ["what it means to be outside"]: a voltage (or i(V), a current) that stays between two values as long as
/// the circuit does what it was designed for. What leaves is told; nothing is stopped.
struct Within {
    Saved what;
    double low, high;
    std::string sentence;  ///< "", if the netlist says nothing
    Place place;

    Range range() const { return {what.name, what.is_voltage() ? "V" : "A", low, high, sentence}; }
    bool holds(double x) const { return x >= low && x <= high; }
};
Result<std::vector<Within>> within_of(const System&);

}  // namespace corpuscle::circuit
