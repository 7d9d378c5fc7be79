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
struct Event {
    std::uint32_t step, unit;
    double offset;
};

/// Result of one job, which simulates some tiles over a block.
struct Job {
    std::vector<Event> events;
    std::int64_t capped = 0, unmarked = 0, passed = 0;
    std::int64_t fired = 0;  ///< number of firing masks
    bool lost = false;       ///< some force or state is NaN or infinite
};

/// A list of firing masks that flushes itself into a job or into spike bits.
template <class V>
struct Collector : FiringList<V> {
    Job& job;
    std::uint64_t* marks;      ///< of this tile, from the chunk's first step on; null: spikes are listed
    std::uint32_t unit, step;  ///< the tile's first afferent, the chunk's first step
    int lanes;

    void empty() {
        job.fired += this->count;
        for (int k = 0; k < this->count; ++k)
            marks ? mark(this->firings[k]) : list(this->firings[k], this->offsets ? this->offsets + k * lanes : nullptr);
        this->count = 0;
    }

private:
    void mark(const Firing& f) {
        auto& word = marks[f.step];
        const auto bits = f.bits << f.unit;
        if ((word & bits) != 0) job.unmarked += std::popcount(word & bits);
        word |= bits;
    }
    void list(const Firing& f, const V* offsets) {
        for (auto bits = f.bits; bits != 0; bits &= bits - 1) {
            const int lane = std::countr_zero(bits);
            job.events.push_back({step + static_cast<std::uint32_t>(f.step), unit + static_cast<std::uint32_t>(f.unit + lane),
                                  offsets ? static_cast<double>(offsets[lane]) : 1.0});
        }
    }
};

/// Appends the events of all jobs as spikes, in order of time, then afferent: a counting sort by step, then a sort within each step.
/// `numbers` are the afferent numbers in spikes, rising; empty: 0, 1, 2 ...
/// `begin` and `at` are scratch arrays.
inline void gather(std::span<const Job> jobs, std::size_t steps, std::int64_t first, std::span<const std::uint32_t> numbers,
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
            spikes[old + at[e.step]++] = {first + e.step, e.offset, numbers.empty() ? e.unit : numbers[e.unit]};
    for (std::size_t t = 0; t < steps; ++t) {
        const auto from = spikes.begin() + static_cast<std::ptrdiff_t>(old + begin[t]),
                   to = spikes.begin() + static_cast<std::ptrdiff_t>(old + begin[t + 1]);
        if (!std::is_sorted(from, to)) std::sort(from, to);
    }
}

}  // namespace corpuscle::lanes
