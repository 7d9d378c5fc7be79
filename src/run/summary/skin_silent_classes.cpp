#include "run/summary/skin_silent_classes.hpp"

#include <algorithm>

#include "run/summary/silent_afferents.hpp"

namespace corpuscle {

Result<void> SkinSilenceDetector::begin(const Input& input) {
    skin_ = &input.skin(), dt_ = input.clock.T(), max_total_force_ = 0;
    has_fired_.assign(skin_->plan.classes.size(), 0), class_max_force_.assign(has_fired_.size(), 0);
    site_peak_.assign(skin_->plan.sites.size(), 0), force_on_afferent_.assign(skin_->afferents.size(), 0);
    total_force_.clear();
    return {};
}

/// Finds the sites with force in the block, and the largest force of each.
void SkinSilenceDetector::find_site_peaks(const RunBlock& block) {
    touched_sites_.clear();
    block.sites.for_each_site(site_peak_.size(), [&](std::size_t site) {
        const double* force = block.sites.data + site * block.sites.stride;
        const double max = *std::max_element(force, force + block.steps);
        if (max > 0) site_peak_[site] = max, touched_sites_.push_back(static_cast<std::uint32_t>(site));
    });
}

/// The upper bound of the force on the afferents of a class in the current block, N.
double SkinSilenceDetector::max_force_on_class(std::size_t class_index) {
    const auto& fields = skin_->fields[class_index];
    double max = 0;
    for (const auto s : touched_sites_)
        for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k)
            max = std::max(max, force_on_afferent_[fields.afferent[k]] += fields.weight[k] * site_peak_[s]);
    for (const auto s : touched_sites_)
        for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k) force_on_afferent_[fields.afferent[k]] = 0;
    return max;
}

Result<void> SkinSilenceDetector::block(const Input&, const RunBlock& block) {
    for (const auto& s : block.spikes) has_fired_[skin_->afferents[s.afferent_index].class_index] = 1;
    if (std::find(has_fired_.begin(), has_fired_.end(), 0) == has_fired_.end() || block.steps == 0) return {};
    const auto remaining = max_silence_samples - std::min(max_silence_samples, total_force_.size());
    const auto total = block.force[0], kept = total.first(std::min(remaining, block.steps));
    total_force_.insert(total_force_.end(), kept.begin(), kept.end());
    max_total_force_ = std::max(max_total_force_, *std::max_element(total.begin(), total.end()));
    find_site_peaks(block);
    for (std::size_t c = 0; c < has_fired_.size(); ++c)
        if (!has_fired_[c]) class_max_force_[c] = std::max(class_max_force_[c], max_force_on_class(c));
    return {};
}

Result<void> SkinSilenceDetector::end(const Input&, std::int64_t, std::span<const Spike> last) {
    for (const auto& s : last) has_fired_[skin_->afferents[s.afferent_index].class_index] = 1;
    return {};
}

std::vector<SilentClass> SkinSilenceDetector::silent_classes(Method method, bool sampled) const {
    std::vector<SilentClass> out;
    for (std::size_t c = 0; c < has_fired_.size(); ++c) {
        if (has_fired_[c] || skin_->class_begin[c + 1] == skin_->class_begin[c]) continue;
        out.push_back({c, class_max_force_[c], {}});
        if (!(class_max_force_[c] > 0 && max_total_force_ > 0)) continue;
        auto force_on_afferent = total_force_;  // the total force over time, scaled to the largest force on an afferent of the class
        for (auto& f : force_on_afferent) f *= class_max_force_[c] / max_total_force_;
        out.back().factor = factor_to_fire(skin_->plan.classes[c].afferent, {dt_, method, sampled, 0, 0}, force_on_afferent);
    }
    return out;
}

}  // namespace corpuscle
