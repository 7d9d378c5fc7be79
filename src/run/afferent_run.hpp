#pragma once
// Simulates every afferent under the force of every source, block by block.

#include <functional>
#include <memory>
#include <vector>

#include "core/force_source.hpp"
#include "model/lane_population.hpp"

namespace corpuscle {

/// One source of force, with one afferent of each plan on each of its channels. The argument `afferent_index` of the functions below counts
/// the afferents of this input from 0: channel * plans.size() + plan. Spike::afferent_index counts the afferents of all inputs; for this
/// input, it is greater by first_afferent.
struct Input {
    const ForceSource& source;
    std::string name;  ///< name of the source; a second source of the same name is called "press (2)"
    std::span<const AfferentPlan> plans;
    std::span<const std::span<const Probe>> probes;  ///< the probes of each plan; empty for a plan on SIMD lanes, which record no probes
    std::uint32_t first_afferent = 0;                ///< Spike::afferent_index of the first afferent of this input
    std::size_t index = 0, input_count = 1;          ///< index of this input, from 0, and number of inputs of the run

    std::size_t afferent_count() const { return source.channels().size() * plans.size(); }
    const AfferentPlan& plan_of(std::size_t afferent_index) const { return plans[afferent_index % plans.size()]; }
    std::size_t channel_of(std::size_t afferent_index) const { return afferent_index / plans.size(); }
    /// The name of a channel in outputs. If there are several inputs, it includes the name of this input.
    std::string channel_name(std::size_t channel) const;
};

/// The response to one block of force.
struct RunBlock {
    std::int64_t first_sample = 0;  ///< index of the block's first sample; 0 is the first sample of the input
    const Frames& force;
    std::span<const Spike> spikes;  ///< spikes of all afferents of this input, in order of time, then afferent index
    /// [afferent of this input][probe][sample]; empty if no sink wants probes.
    const std::vector<std::vector<std::vector<double>>>& probes;
};

/// Receives the response block by block, e.g. a file, a table or a page. An error that it returns ends the run.
class ResponseSink {
public:
    virtual ~ResponseSink() = default;
    virtual bool wants_probes() const { return false; }  ///< true if the sink reads RunBlock::probes
    virtual Result<void> begin(const Input&) { return {}; }
    virtual Result<void> block(const Input&, const RunBlock&) { return {}; }
    /// `samples`: number of samples of the input, on each channel.
    virtual Result<void> end(const Input&, std::int64_t /*samples*/) { return {}; }
};

/// Totals over all inputs of a run.
struct RunStats {
    std::int64_t samples = 0;         ///< force samples, summed over all channels
    std::int64_t afferent_steps = 0;  ///< simulated samples, summed over all afferents
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

struct RespondOptions {
    Method method = Method::exact;
    bool sampled = false;    ///< true: spikes get the time of a sample, as in the thesis; false: a time within the step
    double noise = 0;        ///< A, see SimulationOptions::noise
    std::uint64_t seed = 0;  ///< of the membrane noise
    Precision precision = Precision::double_precision;
    ThreadPool* pool = nullptr;  ///< threads, or null for only the calling thread; the response does not depend on it
    std::size_t block = 4096;    ///< maximum number of samples in a block; the response does not depend on it
    /// Called after each block with the completed fraction of the run, 0 to 1. If it returns false, the run stops.
    std::function<bool(double)> should_continue = [](double) { return true; };
};

/// Simulates all afferents on all channels of all sources. If should_continue stops the run, returns an error of code `interrupted`.
Result<RunStats> respond(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents,
                         std::span<ResponseSink* const> sinks, const RespondOptions&);

/// Warnings about afferents that membrane noise does not affect. `noise` in A.
std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise);

/// Warnings about the response: truncated steps, saturation, overflow, quantities outside their range, and circuits that did not converge.
std::vector<std::string> response_warnings(const RunStats&);

/// Warnings, known before the run, about sources with a sample rate that is too low for an afferent.
std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents);

}  // namespace corpuscle
