#pragma once
// The spikes that many jobs found in a block, put in order.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "signal/spike.hpp"

namespace corpuscle::lanes {

struct Event {
    std::uint32_t step, unit;
    double offset;
};

/// Appends all jobs' events as spikes, in order of time, then unit: counted into their steps, then ordered inside each. `numbers`
/// are what units are called, rising; none: their own numbers.
template <class Jobs>
void gather(const Jobs& jobs, std::size_t steps, std::int64_t first, std::span<const std::uint32_t> numbers, std::vector<Spike>& spikes) {
    std::vector<std::size_t> begin(steps + 1);
    for (const auto& job : jobs)
        for (const auto& e : job.events) ++begin[e.step + 1];
    for (std::size_t t = 0; t < steps; ++t) begin[t + 1] += begin[t];
    const std::size_t old = spikes.size();
    spikes.resize(old + begin[steps]);
    auto at = begin;
    for (const auto& job : jobs)
        for (const auto& e : job.events)
            spikes[old + at[e.step]++] = {first + e.step, e.offset, numbers.empty() ? e.unit : numbers[e.unit]};
    for (std::size_t t = 0; t < steps; ++t) {
        const auto from = spikes.begin() + static_cast<std::ptrdiff_t>(old + begin[t]),
                   to = spikes.begin() + static_cast<std::ptrdiff_t>(old + begin[t + 1]);
        if (!std::is_sorted(from, to)) std::sort(from, to);
    }
}

}  // namespace corpuscle::lanes
