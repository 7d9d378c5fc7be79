#pragma once
// Conduction from the skin to the recording point on the nerve. Each afferent has its own delay, so spikes arrive in another order than
// they were fired.

#include "skin/innervation.hpp"

namespace corpuscle {

class Conduction {
public:
    /// For the afferents of a skin, with samples T apart (s).
    Conduction(const Innervation&, double T);

    /// Adds the spikes fired in the skin up to sample `now`. Appends to `arrived` all spikes that arrive up to this sample, in order of
    /// time, then afferent; no spike fired later can arrive before them. At most `max_samples` samples in one call.
    void deliver(std::span<const Spike> fired, std::int64_t now, std::vector<Spike>& arrived);
    static constexpr std::size_t max_samples = 64;

    /// Spikes that are still in transit, in order.
    std::vector<Spike> in_transit() const;
    /// True if a saved spike can be in transit after sample `now`.
    bool can_be_in_transit(const Spike& s, std::int64_t now) const {
        return s.afferent_index < delays_.size() && s.step > now && s.step < now + static_cast<std::int64_t>(arriving_.size()) &&
               s.offset > 0 && s.offset <= 1;
    }
    void restore(std::span<const Spike>, std::int64_t now);  ///< restores what in_transit() returned after sample `now`

private:
    struct Delay {
        std::int32_t steps;
        double fraction;  // fraction of a step, [0, 1)
    };
    std::vector<Delay> delays_;                 // of each afferent; empty: no delays
    std::vector<std::vector<Spike>> arriving_;  // ring buffer: the spikes that arrive in each of the next steps
    std::int64_t delivered_ = -1;               // the last sample whose spikes have been delivered

    std::vector<Spike>& at(std::int64_t step) { return arriving_[static_cast<std::size_t>(step) % arriving_.size()]; }
};

}  // namespace corpuscle
