#pragma once
// Conduction of spikes from the skin to the recording point on the nerve. Each afferent has its own delay, so the order in which spikes
// arrive differs from the order in which they were fired.

#include "skin/innervation.hpp"

namespace corpuscle {

class Conduction {
public:
    /// For the afferents of a skin; T: s, sampling interval.
    Conduction(const Innervation&, double T);

    /// Takes the spikes fired in the skin since the last call, up to sample `now`, which is at most `max_samples` after that of the last
    /// call. Appends to `arrived` all spikes that arrive up to this sample, in order of time, then afferent. No spike that is fired later
    /// can arrive before them. Samples are counted from 0 at the start of the simulation.
    void deliver(std::span<const Spike> fired, std::int64_t now, std::vector<Spike>& arrived);
    static constexpr std::size_t max_samples = 64;

    /// The spikes that are still in transit, with the times at which they will arrive, in order of time, then afferent.
    std::vector<Spike> in_transit() const;
    /// True if a spike with this arrival time can be in transit after sample `now`.
    bool can_be_in_transit(const Spike& s, std::int64_t now) const {
        return s.afferent_index < delays_.size() && s.step > now && s.step - static_cast<std::int64_t>(arriving_.size()) < now &&
               s.offset > 0 && s.offset <= 1;
    }
    void restore(std::span<const Spike>, std::int64_t now);  ///< the spikes are those of in_transit() after sample `now`

private:
    /// A conduction delay in steps.
    struct Delay {
        std::int32_t steps;  // its integer part
        double fraction;     // the rest, in [0, 1)
    };
    std::vector<Delay> delays_;                 // for each afferent of the skin; empty if no afferent has a delay
    std::vector<std::vector<Spike>> arriving_;  // ring buffer: one list for each of the next steps, with the spikes that arrive in it
    std::int64_t delivered_ = -1;               // the last sample whose spikes have been delivered

    /// The list of a step, counted from the start of the simulation.
    std::vector<Spike>& at(std::int64_t step) { return arriving_[static_cast<std::size_t>(step) % arriving_.size()]; }
};

}  // namespace corpuscle
