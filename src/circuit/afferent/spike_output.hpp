#pragma once
// .spike: the level crossings that are the spikes of a circuit.

#include <optional>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/solve/transient.hpp"

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

}  // namespace corpuscle::circuit
