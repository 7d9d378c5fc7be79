#pragma once
// Collects the firings of lanes in each job and merges them into an ordered list of spikes.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "model/lanes/kernel.hpp"
#include "signal/spike.hpp"

namespace corpuscle::lanes {

/// A spike of a block: its step and its afferent.
struct LaneSpike {
    std::uint32_t step, afferent;
    double offset;
};

/// Result of one job, which simulates some tiles over a block.
struct JobResult {
    std::vector<LaneSpike> events;
    std::int64_t truncated_steps = 0, extra_spikes = 0, skipped_steps = 0;
    std::int64_t firings = 0;  ///< number of firing masks
    bool non_finite = false;   ///< some force or state is NaN or infinite
};

/// A list of firing masks that flushes itself into a job or into spike bits.
template <class V>
struct SpikeCollector : FiringList<V> {
    JobResult& job;
    std::uint64_t* spike_bits;                 ///< of this tile, from the chunk's first step on; null: spikes are listed
    std::uint32_t first_afferent, first_step;  ///< the tile's first afferent, the chunk's first step
    int lanes;

    void flush() {
        job.firings += this->count;
        for (int k = 0; k < this->count; ++k)
            spike_bits ? set_bits(this->firings[k]) : append_spikes(this->firings[k], this->offsets ? this->offsets + k * lanes : nullptr);
        this->count = 0;
    }

private:
    void set_bits(const Firing& f) {
        auto& word = spike_bits[f.step];
        const auto bits = f.bits << f.first;
        if ((word & bits) != 0) job.extra_spikes += std::popcount(word & bits);
        word |= bits;
    }
    void append_spikes(const Firing& f, const V* offsets) {
        for (auto bits = f.bits; bits != 0; bits &= bits - 1) {
            const int lane = std::countr_zero(bits);
            job.events.push_back({first_step + static_cast<std::uint32_t>(f.step),
                                  first_afferent + static_cast<std::uint32_t>(f.first + lane),
                                  offsets ? static_cast<double>(offsets[lane]) : 1.0});
        }
    }
};

/// Appends the events of all jobs as spikes, in order of time, then afferent: a counting sort by step, then a sort within each step.
/// `numbers` are the afferent numbers in spikes, ascending; empty: 0, 1, 2 ... `first` is the first step of the block.
/// `begin` and `at` are scratch arrays.
inline void merge_spikes(std::span<const JobResult> jobs, std::size_t steps, std::int64_t first, std::span<const std::uint32_t> numbers,
                         std::vector<Spike>& spikes, std::vector<std::size_t>& begin, std::vector<std::size_t>& at) {
    begin.assign(steps + 1, 0);
    for (const auto& job : jobs)
        for (const auto& e : job.events) ++begin[e.step + 1];
    for (std::size_t t = 0; t < steps; ++t) begin[t + 1] += begin[t];
    const std::size_t old = spikes.size();
    spikes.resize(old + begin[steps]);
    at = begin;
    for (const auto& job : jobs)
        for (const auto& e : job.events)
            spikes[old + at[e.step]++] = {first + e.step, e.offset, numbers.empty() ? e.afferent : numbers[e.afferent]};
    for (std::size_t t = 0; t < steps; ++t) {
        const auto from = spikes.begin() + static_cast<std::ptrdiff_t>(old + begin[t]),
                   to = spikes.begin() + static_cast<std::ptrdiff_t>(old + begin[t + 1]);
        if (!std::is_sorted(from, to)) std::sort(from, to);
    }
}

}  // namespace corpuscle::lanes
