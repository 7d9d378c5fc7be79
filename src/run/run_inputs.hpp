#pragma once
// run(): from force to spikes. Reads the force of each input block by block, simulates the afferents, and hands the response to the sinks.

#include <functional>
#include <memory>
#include <vector>

#include "core/thread_pool.hpp"
#include "model/lane_population.hpp"
#include "run/sink.hpp"

namespace corpuscle {

struct RespondOptions {
    Method method = Method::exact;
    bool sampled = false;    ///< true: spikes get the time of a sample, as in the thesis; false: a time within the step
    double noise = 0;        ///< A, see SimulationOptions::noise
    std::uint64_t seed = 0;  ///< of all random numbers of the run
    Precision precision = Precision::double_precision;
    ThreadPool* pool = nullptr;  ///< threads, or null for only the calling thread; the response does not depend on it
    std::size_t block = 4096;    ///< maximum number of samples in a block; the response does not depend on it
    /// Called after each block with the completed fraction of the run, 0 to 1, and about 20 times a second within a block of circuits.
    /// If it returns false, the run stops. All calls are by the thread that runs the run.
    std::function<bool(double)> should_continue = [](double) { return true; };

    SimulationOptions for_clock(const Clock& clock) const { return {clock.T(), method, sampled, noise, seed}; }
};

/// Totals over all inputs of a run.
struct RunStats {
    std::int64_t samples = 0;         ///< force samples, summed over all channels; for a skin, of each site
    std::int64_t afferent_steps = 0;  ///< simulated samples, summed over all afferents
    std::int64_t skipped_steps = 0;   ///< of a skin: steps without force that were skipped because the state could not change
    std::int64_t spikes = 0;
    std::int64_t truncated_steps = 0;  ///< steps of afferents that reached the limit of spikes in one step
    std::int64_t saturated = 0;        ///< samples beyond the range of a sensor's electronics or converter
    std::int64_t overflowed = 0;       ///< fixed-point results that exceeded the word length of a digital afferent and were saturated
    std::int64_t steps = 0, rejected = 0, iterations = 0;  ///< of circuits: time steps, rejected time steps, and Newton iterations
    std::vector<std::string> range_warnings;               ///< about quantities that left the range in which the afferent works as designed
    /// The energy that each plan used on all channels of all inputs; 0 for models; empty if all afferents use SIMD lanes.
    std::vector<EnergyUse> energy_use;
    /// One error for each netlist and channel that did not converge, with the time after which the netlist gives no spikes on that channel.
    std::vector<Error> diverged;
};

/// The completed fraction of a run, 0 to 1, from that of the force of this input.
inline double completed_fraction(const Input& input, double of_force) {
    return (static_cast<double>(input.index) + of_force) / static_cast<double>(input.input_count);
}

/// Simulates the afferents of one input: afferents on channels (channels/channel_simulator.cpp) or a skin (skin/skin_simulator.hpp).
class BlockSimulator {
public:
    BlockSimulator() = default;
    BlockSimulator(const BlockSimulator&) = delete;
    BlockSimulator& operator=(const BlockSimulator&) = delete;
    virtual ~BlockSimulator() = default;
    /// Prepares the simulation. `wants_probes`: true if a sink reads RunBlock::probes.
    virtual Result<void> start(const RespondOptions&, bool wants_probes) = 0;
    virtual const Input& input() const = 0;
    /// Reads and simulates the next block, and counts the work. At the end of the force, returns a block without samples.
    virtual Result<RunBlock> next(ThreadPool&, RunStats&) = 0;
    virtual double progress() const = 0;  ///< completed fraction of the force, 0 to 1
    /// Called when the sinks have a block. `stops`: true if the run stops here. A simulator that can be resumed saves its state.
    virtual Result<void> save(bool /*stops*/) { return {}; }
    /// Called at the end of the force. Completes Input::quality and the statistics, and appends spikes that are still being conducted.
    virtual Result<void> finish(std::vector<Spike>&, RunStats&) = 0;
};

/// The simulators of all sources of a run, with one afferent of each plan on every channel.
std::vector<std::unique_ptr<BlockSimulator>> make_channel_simulators(std::span<const std::unique_ptr<ForceSource>>,
                                                                     std::span<const AfferentPlan>);

/// Simulates all inputs, one after another, and frees each simulator after its input. An error of a simulator or a sink ends the run. If
/// should_continue stops it, the error has the code `interrupted`.
Result<RunStats> run(std::vector<std::unique_ptr<BlockSimulator>> inputs, std::span<Sink* const> sinks, const RespondOptions&);

/// Simulates one afferent of each plan on all channels of all sources.
Result<RunStats> run(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> plans,
                     std::span<Sink* const> sinks, const RespondOptions&);

}  // namespace corpuscle
