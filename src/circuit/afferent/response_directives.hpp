#pragma once
// .spike and .assert: the level crossings that are the spikes of a circuit, and its operating range.

#include <optional>

#include "circuit/output/saved_quantities.hpp"
#include "circuit/solve/transient.hpp"
#include "core/afferent.hpp"

namespace corpuscle::circuit {

/// .spike v(NODE[,NODE]) LEVEL [rise|fall]: a spike occurs where the voltage, or the current i(V), crosses the level upwards (default)
/// or downwards.
struct SpikeOutput {
    std::string text;  ///< the quantity: "v(out)"
    OutputVariable unknowns;
    double level = 0;       ///< V or A
    bool is_rising = true;  ///< true if upward crossings are spikes, false if downward ones are
    SourceLocation location;

    /// The time of the first spike within the last step of the transient, s; nothing if the step has no spike.
    std::optional<double> find_spike(const Transient& t) const { return t.crossing(unknowns.plus, unknowns.minus, level, is_rising); }
};

/// Reads the .spike directive; nothing if the circuit has none. A second .spike is an error.
Result<std::optional<SpikeOutput>> read_spike_output(const System&);

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
/// Counts a sample in the violations of each range that does not contain value(quantity).
template <class Value>
void check_ranges(std::span<const OperatingRange> ranges, std::span<RangeViolation> violations, std::int64_t sample, const Value& value) {
    for (std::size_t k = 0; k < violations.size(); ++k)
        if (auto& v = violations[k]; !ranges[k].contains(value(ranges[k].quantity)))
            v = {v.samples + 1, v.first_sample < 0 ? sample : v.first_sample};
}
/// Reads all .assert lines of the system's circuit.
Result<std::vector<OperatingRange>> read_operating_ranges(const System&);

}  // namespace corpuscle::circuit
