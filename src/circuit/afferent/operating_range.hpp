#pragma once
// .assert: the operating range of a circuit.

#include "circuit/output/saved_quantities.hpp"
#include "core/afferent.hpp"

namespace corpuscle::circuit {

/// .assert v(NODE[,NODE]) LOW HIGH ["MESSAGE"]: the range of a voltage, or of a current i(V), in which the circuit works as designed.
/// Violations are reported; the simulation continues.
struct OperatingRange {
    SavedQuantity quantity;
    double low, high;     ///< V or A; both are within the range
    std::string message;  ///< explains a violation; may be ""
    SourceLocation location;

    ValidRange range() const { return {quantity.name, quantity.is_voltage() ? "V" : "A", low, high, message}; }
    /// True if a value of the quantity is within the range.
    bool contains(double x) const { return x >= low && x <= high; }
};
/// Reads all .assert lines of the system's circuit.
Result<std::vector<OperatingRange>> read_operating_ranges(const System&);

}  // namespace corpuscle::circuit
