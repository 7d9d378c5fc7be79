#pragma once
// .spike: the level crossings that are the spikes of a circuit.

#include <optional>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// .spike v(NODE[,NODE]) LEVEL [rise|fall]: a spike occurs where the voltage, or the current i(V), crosses the level upwards (default)
/// or downwards.
struct SpikeOutput {
    std::string text;  ///< "v(out)"
    OutputVariable unknowns;
    double level = 0;
    bool is_rising = true;
    SourceLocation location;

    /// The time of a spike within the last step of the transient, s; nothing if there is none.
    std::optional<double> find_spike(const Transient& t) const { return t.crossing(unknowns.plus, unknowns.minus, level, is_rising); }
};

/// Reads the .spike directive; nothing if there is none. A second one is an error.
Result<std::optional<SpikeOutput>> read_spike_output(const System&);

}  // namespace corpuscle::circuit
