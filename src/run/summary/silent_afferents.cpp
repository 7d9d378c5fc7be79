#include "run/summary/silent_afferents.hpp"

#include <algorithm>
#include <cmath>

#include "run/firing_factor.hpp"

namespace corpuscle {
namespace {

/// Raises the upper bounds of the force on the afferents of each silent class of a skin to those of this block.
void raise_class_forces(const Innervation& skin, const RunBlock& block, std::span<const char> is_silent, std::vector<double>& class_force) {
    struct SitePeak {
        std::size_t site;
        double normal, shear;  // N, the largest in the block; `shear` is a bound for every direction
    };
    std::vector<SitePeak> peaks;
    block.sites.for_each_site(skin.plan.sites.size(), [&](std::size_t site) {
        SitePeak peak{site, 0, 0};
        block.sites.for_each_component([&](const double* component) {
            const double* force = component + site * block.sites.stride;
            for (std::size_t t = 0; t < block.steps; ++t)
                component == block.sites.data ? peak.normal = std::max(peak.normal, force[t])
                                              : peak.shear = std::max(peak.shear, std::abs(force[t]));
        });
        if (peak.normal > 0 || peak.shear > 0) peaks.push_back(peak);
    });
    for (std::size_t c = 0; c < class_force.size(); ++c) {
        if (!is_silent[c]) continue;
        const auto& fields = skin.fields[c];
        std::vector<double> on_receptor((skin.class_begin[c + 1] - skin.class_begin[c]) * fields.receptors);
        const double gain = skin.plan.classes[c].direction.gain;
        for (const auto& [site, normal, shear] : peaks)
            for (auto k = fields.begin[site]; k < fields.begin[site + 1]; ++k)
                on_receptor[fields.afferent[k]] += fields.weight[k] * normal + std::abs(fields.weight[k]) * gain * shear;
        for (const double force : on_receptor) class_force[c] = std::max(class_force[c], force);
    }
}

}  // namespace

Result<void> SilenceDetector::begin(const Input& input) {
    const auto& population = input.population;
    if (input.index == 0) {
        plans_.clear(), is_silent_.assign(population.class_count(), 0);
        for (std::size_t c = 0; c < is_silent_.size(); ++c) plans_.push_back(&population.class_plan(c));
        for (std::size_t u = 0; u < population.size(); ++u) is_silent_[population.class_of(u)] = 1;
        class_force_.assign(population.skin() ? is_silent_.size() : 0, 0);
    }
    row_samples_.assign(population.force_names().size(), {});
    row_max_.assign(row_samples_.size(), 0);
    return {};
}

Result<void> SilenceDetector::block(const Input& input, const RunBlock& block) {
    for (const auto& s : block.spikes) is_silent_[input.population.class_of(input.afferent_of(s))] = 0;
    if (std::find(is_silent_.begin(), is_silent_.end(), 1) == is_silent_.end()) return {};
    const std::size_t max_samples = max_silence_samples / row_samples_.size();
    for (std::size_t r = 0; r < row_samples_.size(); ++r) {
        const auto force = block.force[r],
                   kept = force.first(std::min(block.steps, max_samples - std::min(max_samples, row_samples_[r].size())));
        row_samples_[r].insert(row_samples_[r].end(), kept.begin(), kept.end());
        for (const double f : force) row_max_[r] = std::max(row_max_[r], f);
    }
    if (!class_force_.empty()) raise_class_forces(input.skin(), block, is_silent_, class_force_);
    return {};
}

Result<void> SilenceDetector::end(const Input& input, std::int64_t, std::span<const Spike> last) {
    for (const auto& s : last) is_silent_[input.population.class_of(input.afferent_of(s))] = 0;
    const auto max = std::max_element(row_max_.begin(), row_max_.end());
    if (*max > largest_force_) {
        largest_force_ = *max, dt_ = input.clock.T();
        largest_force_samples_ = std::move(row_samples_[static_cast<std::size_t>(max - row_max_.begin())]);
    }
    row_samples_.clear();
    if (input.index + 1 == input.input_count) keep_silent_plans();
    return {};
}

void SilenceDetector::keep_silent_plans() {
    silent_plans_.assign(plans_.size(), {});
    for (std::size_t c = 0; c < plans_.size(); ++c)
        if (is_silent_[c]) silent_plans_[c] = *plans_[c];
    if (std::find(is_silent_.begin(), is_silent_.end(), 1) == is_silent_.end()) largest_force_samples_ = {};
    plans_.clear();
}

std::vector<SilentClass> SilenceDetector::silent_classes(const RespondOptions& options) const {
    std::vector<SilentClass> out;
    for (std::size_t c = 0; c < is_silent_.size(); ++c) {
        if (!is_silent_[c] || !silent_plans_[c].traits().can_search_factor) continue;
        out.push_back({c, class_force_.empty() ? largest_force_ : class_force_[c], {}});
        if (!(out.back().max_force > 0 && largest_force_ > 0)) continue;
        auto force = largest_force_samples_;  // scaled to the largest force on an afferent of the class
        for (auto& f : force) f *= out.back().max_force / largest_force_;
        out.back().factor = factor_to_fire(silent_plans_[c], {dt_, options.method, options.sampled, 0, 0}, force);
    }
    return out;
}

}  // namespace corpuscle
