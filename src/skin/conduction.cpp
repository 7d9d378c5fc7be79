#include "skin/conduction.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

void append_sorted(std::span<const Spike> spikes, std::vector<Spike>& to) {
    const auto old = static_cast<std::ptrdiff_t>(to.size());
    to.insert(to.end(), spikes.begin(), spikes.end());
    if (!std::is_sorted(to.begin() + old, to.end())) std::sort(to.begin() + old, to.end());
}

}  // namespace

Conduction::Conduction(const Innervation& skin, double T) {
    if (std::all_of(skin.afferents.begin(), skin.afferents.end(), [](const SkinAfferent& u) { return u.delay == 0; })) return;
    std::int32_t max_steps = 0;
    for (const auto& u : skin.afferents) {
        const double steps = u.delay / T, full_steps = std::floor(steps);
        delays_.push_back({static_cast<std::int32_t>(full_steps), steps - full_steps});
        max_steps = std::max(max_steps, delays_.back().steps);
    }
    // A spike arrives at most max_steps + 1 steps after its own, which is at most max_samples after the last delivered one.
    arriving_.resize(static_cast<std::size_t>(max_steps) + 2 + max_samples);
    // Space for a spike of every afferent of a small skin, so that bursts need no allocation.
    for (auto& step : arriving_) step.reserve(std::min(skin.afferents.size(), skin.afferents.size() / 16 + 512));
}

void Conduction::deliver(std::span<const Spike> fired, std::int64_t now, std::vector<Spike>& arrived) {
    if (delays_.empty()) return append_sorted(fired, arrived);
    for (const auto& s : fired) {
        const auto& d = delays_[s.afferent_index];
        const double offset = s.offset + d.fraction;  // in (0, 2)
        const bool in_next_step = offset > 1;
        const std::int64_t step = s.step + d.steps + (in_next_step ? 1 : 0);
        at(step).push_back({step, in_next_step ? offset - 1 : offset, s.afferent_index});
    }
    for (; delivered_ < now; ++delivered_) {
        auto& due = at(delivered_ + 1);
        append_sorted(due, arrived);
        due.clear();
    }
}

std::vector<Spike> Conduction::in_transit() const {
    std::vector<Spike> all;
    for (const auto& step : arriving_) all.insert(all.end(), step.begin(), step.end());
    std::sort(all.begin(), all.end());
    return all;
}

void Conduction::restore(std::span<const Spike> spikes, std::int64_t now) {
    delivered_ = now;
    for (auto& step : arriving_) step.clear();
    for (const auto& s : spikes) at(s.step).push_back(s);
}

}  // namespace corpuscle
