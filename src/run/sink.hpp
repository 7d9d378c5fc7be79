#pragma once
// A sink receives the response of a run block by block: a file, a summary, a table or a page.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/afferent.hpp"
#include "core/force_source.hpp"
#include "io/spikes/events.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

class ChannelPopulation;

/// The afferents whose spikes are counted together in bins of time (psth.csv).
struct BinGroups {
    struct Group {
        std::string names;     ///< of the group, as CSV fields: "sa1,press"
        double afferents = 1;  ///< number of afferents in the group
    };
    std::string columns;  ///< the headings of the names: "afferent,channel"
    std::vector<Group> groups;
    std::vector<std::uint32_t> group_of;  ///< for each afferent, the index of its group
};

/// The plan of each afferent of a population. Afferents with equal plans share one.
struct PlanTable {
    std::vector<AfferentPlan> plans;
    std::vector<std::uint32_t> plan_of;  ///< for each afferent, the index of its plan
};

/// The afferents of one input of a run: afferents on channels, or the afferents of a skin. The argument `u` is the index of an afferent
/// within the input, from 0. Spike::afferent_index is greater by Input::first_afferent.
class Population {
public:
    virtual ~Population() = default;
    virtual std::size_t size() const = 0;                             ///< number of afferents
    virtual std::string afferent_name(std::size_t u) const = 0;       ///< "sa1"; of a copy or in a skin "sa1#17"
    virtual std::string channel_name(std::size_t u) const = 0;        ///< the channel, or the region of the skin
    virtual std::vector<std::string> force_names() const = 0;         ///< of the rows of RunBlock::force
    virtual std::size_t class_count() const = 0;                      ///< number of requested afferents, or of classes of the skin
    virtual std::size_t class_of(std::size_t u) const = 0;            ///< copies of an afferent are one class
    virtual const AfferentPlan& class_plan(std::size_t c) const = 0;  ///< of the first copy, or around which the class of a skin varies
    virtual std::span<const Probe> probes(std::size_t u) const = 0;   ///< the recorded quantities; empty if none are recorded
    virtual BinGroups bin_groups() const = 0;
    virtual Result<PlanTable> plan_table() const = 0;
    /// Names and addresses in event formats, for spikes whose afferent indexes are those within the input.
    virtual EventAddressing event_addressing(const Clock&) const = 0;
    /// In the skin, m; no value on channels, because a layout need not state the unit of its positions.
    virtual std::optional<Position> position(std::size_t) const { return {}; }

    // Summaries and reports differ between the two implementations. One of these is not null.
    virtual const ChannelPopulation* on_channels() const { return nullptr; }
    virtual const Innervation* skin() const { return nullptr; }
};

/// The force of an input, without its samples.
struct InputDescription {
    std::string name;  ///< name of the source or touch; a second source of the same name is called "press (2)"
    std::string description = {};
    Clock clock = {};
    std::vector<Phase> phases = {};  ///< of a stimulus
    double cycle_frequency = 0;      ///< Hz, at which the force repeats; 0 if it is not periodic
    std::vector<MetadataEntry> metadata = {};
    std::vector<std::string> notes = {};
    bool is_recording = false;      ///< the force was measured
    RecordingQuality quality = {};  ///< complete only in Sink::end()

    /// The clock with the first sample at 0 s. Times since 1970 would lose precision.
    Clock clock_since_start() const { return {clock.rate_numerator, clock.rate_denominator, 0}; }
    /// The time of a spike or of a sample on that clock, s.
    double since_start(const Spike& s) const { return clock_since_start().time(s.step, s.offset); }
    double since_start(std::int64_t sample) const { return clock_since_start().time(sample); }
};

/// One source of force, and the afferents that respond to it.
struct Input : InputDescription {
    const Population& population;
    std::uint32_t first_afferent = 0;        ///< Spike::afferent_index of the first afferent of this input
    std::size_t index = 0, input_count = 1;  ///< index of this input, from 0, and number of inputs of the run

    const ChannelPopulation& on_channels() const { return *population.on_channels(); }  ///< only for afferents on channels
    const Innervation& skin() const { return *population.skin(); }                      ///< only for a skin
    /// The index of a spike's afferent within this input.
    std::size_t afferent_of(const Spike& s) const { return s.afferent_index - first_afferent; }
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
