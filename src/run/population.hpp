#pragma once
// The afferents of one input of a run, as sinks see them: afferents on channels, or the afferents of a skin.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/afferent.hpp"
#include "core/force_source.hpp"
#include "io/spikes/events.hpp"

namespace corpuscle {

struct AfferentPlan;
class ChannelPopulation;
struct Innervation;

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

/// The argument `u` is the index of an afferent within the input, from 0. Spike::afferent_index is greater by Input::first_afferent.
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
    /// Names and addresses in event formats, for spikes whose afferent indexes are those within the input.
    virtual EventAddressing event_addressing(const Clock&) const = 0;
    /// In the skin, m; no value on channels, because a layout need not state the unit of its positions.
    virtual std::optional<Position> position(std::size_t) const { return {}; }

    // Summaries and reports differ between the two implementations. One of these is not null.
    virtual const ChannelPopulation* on_channels() const { return nullptr; }
    virtual const Innervation* skin() const { return nullptr; }
};

}  // namespace corpuscle
