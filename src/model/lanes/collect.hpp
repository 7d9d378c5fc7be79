#pragma once
// From the firings of lanes to spikes in order: collected by each job, then put together.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "model/lanes/kernel.hpp"
#include "signal/spike.hpp"

namespace corpuscle::lanes {

/// A spike of a block: in its step, of a unit.
struct Event {
    std::uint32_t step, unit;
    double offset;
};

/// What one job, some tiles over a block, found.
struct Job {
    std::vector<Event> events;
    std::int64_t capped = 0, unmarked = 0, passed = 0;
    std::int64_t fired = 0;  ///< how often any did
    bool lost = false;       ///< some force or state is no number
};

/// A list of firings that empties itself into a job, or into marks.
template <class V>
struct Collector : FiringList<V> {
    Job& job;
    std::uint64_t* marks;      ///< of this tile, from the chunk's first step on; or null
    std::uint32_t unit, step;  ///< the tile's first, the chunk's first
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

/// Appends all jobs' events as spikes, in order of time, then unit: counted into their steps, then ordered inside each. `numbers`
/// are what units are called, rising; none: their own numbers.
/// `begin` and `at` are room to work in.
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
