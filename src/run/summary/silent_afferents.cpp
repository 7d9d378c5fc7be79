#include "run/summary/silent_afferents.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/catalog.hpp"
#include "model/copies.hpp"
#include "run/channels/channel_population.hpp"

namespace corpuscle {
namespace {

constexpr double max_factor = 1e6;
constexpr double factor_tolerance = 1.02;  // the search stops when its bounds differ by this ratio

/// True if the afferent fires at least once when the force is multiplied by `factor`. False after an error.
bool fires_with_factor(const Afferent& afferent, std::span<const double> force, double factor) {
    constexpr std::size_t block = 4096;
    std::vector<double> scaled(block);
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    auto state = afferent.start();
    for (std::size_t at = 0; at < force.size(); at += block) {
        const auto count = std::min(block, force.size() - at);
        for (std::size_t k = 0; k < count; ++k) scaled[k] = factor * force[at + k];
        if (!afferent.respond({scaled.data(), count}, state, response)) return false;
        if (!spikes.empty()) return true;
    }
    return false;
}

}  // namespace

std::optional<double> factor_to_fire(const AfferentPlan& plan, const SimulationOptions& run, std::span<const double> force) {
    const auto afferent = make_afferent(plan, run);
    double low = 1, high = 1;  // it fires at `high`, and not at `low` unless both are 1
    while (!fires_with_factor(*afferent, force, high)) {
        if (high >= max_factor) return {};
        low = high, high *= 2;
    }
    while (high > low * factor_tolerance) {
        const double midpoint = std::sqrt(low * high);
        (fires_with_factor(*afferent, force, midpoint) ? high : low) = midpoint;
    }
    return high;
}

Result<void> SilenceDetector::begin(const Input& input) {
    force_samples_.assign(input.on_channels().channels(), {});
    channel_max_.assign(force_samples_.size(), 0);
    has_fired_.resize(input.on_channels().plans().size());
    return {};
}

Result<void> SilenceDetector::block(const Input& input, const RunBlock& block) {
    const std::size_t max_samples = max_silence_samples / force_samples_.size();
    for (std::size_t c = 0; c < force_samples_.size(); ++c) {
        const auto* force = block.force[c].data();
        const auto count = std::min(block.steps, max_samples - std::min(max_samples, force_samples_[c].size()));
        force_samples_[c].insert(force_samples_[c].end(), force, force + count);
        for (std::size_t k = 0; k < block.steps; ++k) channel_max_[c] = std::max(channel_max_[c], force[k]);
    }
    for (const auto& s : block.spikes) has_fired_[input.afferent_of(s) % has_fired_.size()] = 1;
    return {};
}

Result<void> SilenceDetector::end(const Input& input, std::int64_t, std::span<const Spike>) {
    const auto max = std::max_element(channel_max_.begin(), channel_max_.end());
    if (*max > largest_force_) {
        largest_force_ = *max, dt_ = input.clock.T();
        largest_force_samples_ = std::move(force_samples_[static_cast<std::size_t>(max - channel_max_.begin())]);
    }
    force_samples_.clear();
    return {};
}

std::vector<SilentAfferent> SilenceDetector::silent_afferents(std::span<const AfferentPlan> afferents,
                                                              const RespondOptions& options) const {
    std::vector<SilentAfferent> out;
    const auto groups = copy_group_starts(afferents);
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        const auto& plan = afferents[groups[g]];
        const auto from = has_fired_.begin() + static_cast<std::ptrdiff_t>(groups[g]),
                   to = has_fired_.begin() + static_cast<std::ptrdiff_t>(groups[g + 1]);
        if (!plan.traits().can_search_factor || std::find(from, to, 1) != to) continue;
        out.push_back({base_name(plan), largest_force_, {}});
        if (largest_force_ > 0)
            out.back().factor = factor_to_fire(plan, {dt_, options.method, options.sampled, 0, 0}, largest_force_samples_);
    }
    return out;
}

std::string silence_message(const SilentAfferent& silent) {
    const auto never = fmt::format("{} never fired: the largest force was {:.3g} N", silent.name, silent.force);
    if (silent.factor) return fmt::format("{}; it would fire at about {} times this force", never, format_rounded_up(*silent.factor));
    return silent.force > 0 ? fmt::format("{}, and even a million times this force would not make it fire", never) : never;
}

std::string format_rounded_up(double x) {
    if (!(x > 0) || !std::isfinite(x)) return fmt::format("{:g}", x);
    const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    return fmt::format("{:.6g}", std::ceil(x / unit - 1e-9) * unit);
}

}  // namespace corpuscle
