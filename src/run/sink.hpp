#pragma once
// A sink receives the response of a run block by block: a file, a summary, a table or a page.

#include <span>
#include <string>
#include <vector>

#include "core/force_source.hpp"
#include "run/population.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// One source of force, and the afferents that respond to it.
struct Input {
    const Population& population;
    std::string name;  ///< name of the source or touch; a second source of the same name is called "press (2)"
    std::string description = {};
    Clock clock = {};
    std::vector<Phase> phases = {};  ///< of a stimulus
    double cycle_frequency = 0;      ///< Hz, at which the force repeats; 0 if it is not periodic
    std::vector<MetadataEntry> metadata = {};
    std::vector<std::string> notes = {};
    RecordingQuality quality = {};           ///< complete only in Sink::end()
    std::uint32_t first_afferent = 0;        ///< Spike::afferent_index of the first afferent of this input
    std::size_t index = 0, input_count = 1;  ///< index of this input, from 0, and number of inputs of the run

    const ChannelPopulation& on_channels() const { return *population.on_channels(); }  ///< only for afferents on channels
    const Innervation& skin() const { return *population.skin(); }                      ///< only for a skin
    /// The index of a spike's afferent within this input.
    std::size_t afferent_of(const Spike& s) const { return s.afferent_index - first_afferent; }
    /// The clock with the first sample at 0 s. Times since 1970 would lose precision.
    Clock clock_since_start() const { return {clock.rate_numerator, clock.rate_denominator, 0}; }
    /// The time of a spike or of a sample on that clock, s.
    double since_start(const Spike& s) const { return clock_since_start().time(s.step, s.offset); }
    double since_start(std::int64_t sample) const { return clock_since_start().time(sample); }
};

/// The input of this population, with the clock, phases and notes of the source.
Input make_input(const Population&, std::string name, const ForceSource&);

/// The response to one block of force. Valid until the next block.
struct RunBlock {
    std::int64_t first_sample = 0;  ///< index of the block's first sample; 0 is the first sample of the input
    std::size_t steps = 0;          ///< number of samples
    /// [row][sample], N: the force on each channel; for a skin, one row with the total force of all sites.
    std::span<const std::span<const double>> force = {};
    SiteForce sites = {};                ///< for a skin: the force at its sites
    std::span<const Spike> spikes = {};  ///< of all afferents of this input, in order of time, then afferent index
    /// [afferent of this input][probe][sample]; empty if no sink wants probes.
    std::span<const std::vector<std::vector<double>>> probes = {};

    std::int64_t end_sample() const { return first_sample + static_cast<std::int64_t>(steps); }
};

/// An error that a function returns ends the run.
class Sink {
public:
    virtual ~Sink() = default;
    virtual bool wants_probes() const { return false; }  ///< true if the sink reads RunBlock::probes
    virtual Result<void> begin(const Input&) { return {}; }
    virtual Result<void> block(const Input&, const RunBlock&) { return {}; }
    /// `samples`: number of samples of the input. `last`: spikes that nerve fibres are still conducting at the end of the force.
    virtual Result<void> end(const Input&, std::int64_t /*samples*/, std::span<const Spike> /*last*/) { return {}; }
};

}  // namespace corpuscle
