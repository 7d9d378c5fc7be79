#pragma once
// Simulates every source of force with every afferent, block by block.

#include <functional>
#include <memory>
#include <vector>

#include "model/lane_population.hpp"
#include "signal/force_source.hpp"

namespace corpuscle {

/// One source with one afferent of each plan on each of its channels. Here, an afferent's index is channel * plans + plan. In the complete
/// run (Spike::afferent_index), it is greater by first_afferent.
struct Input {
    const ForceSource& source;
    std::string name;  ///< name of the source; a second source of the same name is called "press (2)"
    std::span<const AfferentPlan> plans;
    std::span<const std::span<const Probe>> probes;  ///< of each plan; empty for a plan on SIMD lanes, which record no probes
    std::uint32_t first_afferent = 0;
    std::size_t index = 0, input_count = 1;  ///< index of this input, and number of inputs

    std::size_t afferent_count() const { return source.channels().size() * plans.size(); }
    const AfferentPlan& plan_of(std::size_t afferent_index) const { return plans[afferent_index % plans.size()]; }
    std::size_t channel_of(std::size_t afferent_index) const { return afferent_index / plans.size(); }
    /// The channel's name in outputs; preceded by the source's name if there are several sources.
    std::string channel_name(std::size_t channel) const;
};

/// The response to one block of force.
struct RunBlock {
    std::int64_t first_sample = 0;  ///< index of the block's first sample
    const Frames& force;
    std::span<const Spike> spikes;                                ///< spikes of all afferents, in order of time, then afferent index
    const std::vector<std::vector<std::vector<double>>>& probes;  ///< [afferent of this input][probe][sample]; empty if no sink wants them
};

/// Receives the response block by block, e.g. a file, a table or a page. An error that it returns ends the run.
class ResponseSink {
public:
    virtual ~ResponseSink() = default;
    virtual bool wants_probes() const { return false; }
    virtual Result<void> begin(const Input&) { return {}; }
    virtual Result<void> block(const Input&, const RunBlock&) { return {}; }
    virtual Result<void> end(const Input&, std::int64_t /*samples*/) { return {}; }
};

struct RunStats {
    std::int64_t samples = 0;         ///< force samples, summed over all channels
    std::int64_t afferent_steps = 0;  ///< force samples, summed over all afferents
    std::int64_t spikes = 0;
    std::int64_t truncated_steps = 0;                      ///< steps that reached the limit on spikes in one step
    std::int64_t saturated = 0;                            ///< samples beyond the range of a sensor's electronics or converter
    std::int64_t overflowed = 0;                           ///< results that overflowed the word length of a digital afferent
    std::int64_t steps = 0, rejected = 0, iterations = 0;  ///< of circuits: time steps, rejected time steps, and Newton iterations
    std::vector<std::string> range_warnings;               ///< quantities that left the range in which an afferent works as designed
    std::vector<EnergyUse> energy_use;  ///< of each plan, summed over its channels; 0 for models; empty if all use SIMD lanes
    std::vector<Error> diverged;        ///< netlists that did not converge, with channel and time; they fire no more on that channel
};

struct RespondOptions {
    Method method = Method::exact;
    bool sampled = false;    ///< spikes only at sample times
    double noise = 0;        ///< of every membrane, see SimulationOptions
    std::uint64_t seed = 0;  ///< of the noise
    Precision precision = Precision::double_precision;
    ThreadPool* pool = nullptr;  ///< threads, or null for only the calling thread; the response does not depend on it
    std::size_t block = 4096;    ///< samples; the response does not depend on it
    /// Called once a block with the completed fraction, 0 to 1; false stops the run.
    std::function<bool(double)> should_continue = [](double) { return true; };
};

/// Simulates all afferents with all sources. A run that should_continue stops returns an error of code `interrupted`.
Result<RunStats> respond(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents,
                         std::span<ResponseSink* const> sinks, const RespondOptions&);

/// Warnings about noise: the afferents that it does not affect.
std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise);

/// Warnings about the response: steps that reached the limit on spikes, saturation, overflow.
std::vector<std::string> response_warnings(const RunStats&);

/// Warnings before the run: sample rates that are too low for an afferent.
std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents);

}  // namespace corpuscle
