#pragma once
// A spike, and the times of a spike train.

#include <compare>
#include <span>
#include <vector>

#include "core/clock.hpp"

namespace corpuscle {

/// A spike in the interval that ends at sample `step`. Its time is Clock::time(step, offset).
struct Spike {
    std::int64_t step = 0;             ///< index of the sample, counted from the start of the simulation
    double offset = 1;                 ///< position in the interval, in (0, 1]; 1 is the sample itself
    std::uint32_t afferent_index = 0;  ///< given by the caller of the simulation; each afferent on each channel has an index of its own

    friend auto operator<=>(const Spike&, const Spike&) = default;  // by time, then by afferent index
};

/// The times of the spikes in s, in the order of `train`.
inline std::vector<double> spike_times(std::span<const Spike> train, const Clock& clock) {
    std::vector<double> out;
    out.reserve(train.size());
    for (const Spike& s : train) out.push_back(clock.time(s.step, s.offset));
    return out;
}

}  // namespace corpuscle
