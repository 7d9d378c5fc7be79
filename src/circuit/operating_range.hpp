#pragma once
// .assert: the operating range of a circuit.

#include "circuit/saved_quantities.hpp"
#include "signal/afferent.hpp"

namespace corpuscle::circuit {

/// .assert v(NODE[,NODE]) LOW HIGH ["MESSAGE"]: the range of a voltage, or of a current i(V), in which the circuit works as designed.
/// Violations are reported; the simulation continues.
struct OperatingRange {
    SavedQuantity quantity;
    double low, high;
    std::string message;  ///< explains a violation; may be ""
    SourceLocation location;

    ValidRange range() const { return {quantity.name, quantity.is_voltage() ? "V" : "A", low, high, message}; }
    bool contains(double x) const { return x >= low && x <= high; }
};
Result<std::vector<OperatingRange>> read_operating_ranges(const System&);

}  // namespace corpuscle::circuit
