#pragma once
// Simulates one afferent. AfferentSimulation handles the delay of an afferent, whose response lags behind the force; ChannelSimulator reads
// that far ahead with a LookaheadBuffer.

#include <functional>
#include <span>
#include <vector>

#include "core/afferent.hpp"

namespace corpuscle {

/// An afferent during a simulation, block by block.
class AfferentSimulation {
    const Afferent& afferent_;
    State state_;
    std::size_t delay_;  // samples
    bool has_started_ = false;

public:
    explicit AfferentSimulation(const Afferent& afferent, ChannelSlot slot = {})
        : afferent_(afferent), state_(afferent.start(slot)), delay_(static_cast<std::size_t>(afferent.delay())) {}

    /// Simulates the next block. `force` (N) is the force of the block and of the delay() samples after it; at the end of the force its
    /// last value is repeated. Probes and counters of range violations belong to the block.
    Result<void> respond(std::span<const double> force, ResponseBlock&);
};

/// The samples `first` to `first` + `count` - 1 of a force, which it has, and `delay` samples after them. At its end, the last value is
/// repeated.
std::vector<double> padded_block(std::span<const double> force, std::size_t first, std::size_t count, std::size_t delay);

struct SimulateOptions {
    std::span<const std::size_t> probes = {};  ///< indexes into the afferent's probes: those to record
    std::size_t every = 1;                     ///< 1: all samples of a probe are recorded; 2: every second one, beginning with the first
    std::function<bool()> stop = {};           ///< called often; true ends the simulation with an error of code `interrupted`
};

/// The response of one afferent to a complete force.
struct AfferentResponse {
    std::vector<Spike> spikes;                     ///< in order of time; steps count from the first sample of the force
    std::vector<std::vector<double>> probes;       ///< for each requested probe, its recorded samples
    std::vector<RangeViolation> range_violations;  ///< for each valid range of the afferent
};

/// Simulates an afferent with a complete force, N, one value per sample. Errors are those of Afferent::respond().
Result<AfferentResponse> simulate(const Afferent&, std::span<const double> force, const SimulateOptions& = {});

}  // namespace corpuscle
