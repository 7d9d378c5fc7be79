#pragma once
// .spike: which node's crossings are the circuit's spikes.

#include <optional>

#include "circuit/analysis/bench.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// .spike v(NODE[,NODE]) LEVEL [rise|fall]: a spike is where the voltage (or i(V), a current) crosses the level upwards, or downwards.
struct SpikeOutput {
    std::string text;  ///< "v(out)"
    Wanted of;
    double level = 0;
    bool upwards = true;
    Place place;

    /// The time of a spike within a transient's last step.
    std::optional<double> within(const Transient& t) const { return t.crossing(of.plus, of.minus, level, upwards); }
};

/// What the netlist says; nothing, if it says nothing. A second one is refused.
Result<std::optional<SpikeOutput>> spike_output(const System&);

}  // namespace corpuscle::circuit
