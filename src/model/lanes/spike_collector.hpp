#pragma once
// Collects the spikes of each job, which simulates some tiles over a block, and merges those of all jobs into a list ordered by time.

#include <algorithm>
#include <bit>
#include <vector>

#include "core/spike.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

/// A spike in a block.
struct LaneSpike {
    std::uint32_t step, afferent;  ///< step of the block; index of the afferent in the population
    double offset;                 ///< time within the step, in (0, 1]
};

/// Result of one job, which simulates some tiles over a block.
struct JobResult {
    std::vector<LaneSpike> events;                                          ///< the spikes, if they are listed
    std::int64_t truncated_steps = 0, extra_spikes = 0, skipped_steps = 0;  ///< as in PopulationResponse
    std::int64_t firings = 0;                                               ///< number of firing masks
    bool non_finite = false;                                                ///< true if some force or state may be NaN or infinite
};

/// A list of firing masks of one tile in one chunk. flush() moves them to the job's spikes, or sets spike bits.
template <class V>
struct SpikeCollector : FiringList<V> {
    JobResult& job;
    std::uint64_t* spike_bits;  ///< one word of this tile for each step, from the chunk's first step on; null: spikes are listed
    std::uint32_t first_afferent, first_step;  ///< the tile's first afferent in the population; the chunk's first step in the block
    int lanes;                                 ///< afferents in a vector

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

/// Appends the events of all jobs to `spikes`, in order of time, then afferent: a counting sort by step, then a sort within each step.
/// `first` is the number of the block's first sample since the start of the simulation. `numbers` are the afferents' numbers in `spikes`,
/// ascending; empty: 0, 1, 2 ... `begin` and `at` are scratch arrays.
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
