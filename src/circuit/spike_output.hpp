#pragma once
// .spike: the level crossings that are the spikes of a circuit.

#include <optional>

#include "circuit/analysis/bench.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// .spike v(NODE[,NODE]) LEVEL [rise|fall]: a spike occurs where the voltage, or the current i(V), crosses the level upwards (default)
/// or downwards.
struct SpikeOutput {
    std::string text;  ///< "v(out)"
    Wanted of;
    double level = 0;
    bool upwards = true;
    SourceLocation place;

    /// The time of a spike within the last step of the transient, s; nothing if there is none.
    std::optional<double> within(const Transient& t) const { return t.crossing(of.plus, of.minus, level, upwards); }
};

/// Reads the .spike directive; nothing if there is none. A second one is an error.
Result<std::optional<SpikeOutput>> spike_output(const System&);

}  // namespace corpuscle::circuit
