#include "study/skin_silence.hpp"

#include <algorithm>

#include "study/silence.hpp"

namespace corpuscle {

Result<void> SkinSilence::begin(const SkinInput& input) {
    skin_ = &input.skin, dt_ = input.clock.T(), largest_ = 0;
    fired_.assign(skin_->plan.classes.size(), 0), felt_.assign(fired_.size(), 0);
    peak_.assign(skin_->plan.sites.size(), 0), of_unit_.assign(skin_->afferents.size(), 0);
    course_.clear();
    return {};
}

/// Finds the sites with force, and the largest force of each.
void SkinSilence::find_peaks(const SkinAnswered& block) {
    touched_.clear();
    const auto add = [&](std::uint32_t site) {
        const double* force = block.force.data + site * block.force.stride;
        const double max = *std::max_element(force, force + block.steps);
        if (max > 0) peak_[site] = max, touched_.push_back(site);
    };
    for (std::uint32_t s = 0; block.force.reads_all && s < peak_.size(); ++s) add(s);
    for (const auto s : block.force.touched)
        if (!block.force.reads_all) add(s);
}

double SkinSilence::most_felt(std::size_t class_index) {
    const auto& fields = skin_->fields[class_index];
    double max = 0;
    for (const auto s : touched_)
        for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k)
            max = std::max(max, of_unit_[fields.afferent[k]] += fields.weight[k] * peak_[s]);
    for (const auto s : touched_)
        for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k) of_unit_[fields.afferent[k]] = 0;
    return max;
}

Result<void> SkinSilence::block(const SkinInput&, const SkinAnswered& block) {
    for (const auto& s : block.spikes) fired_[skin_->afferents[s.afferent_index].class_index] = 1;
    if (std::find(fired_.begin(), fired_.end(), 0) == fired_.end() || block.steps == 0) return {};
    const auto remaining = most_silent_samples - std::min(most_silent_samples, course_.size());
    course_.insert(course_.end(), block.total.begin(), block.total.begin() + static_cast<std::ptrdiff_t>(std::min(remaining, block.steps)));
    largest_ = std::max(largest_, *std::max_element(block.total.begin(), block.total.end()));
    find_peaks(block);
    for (std::size_t c = 0; c < fired_.size(); ++c)
        if (!fired_[c]) felt_[c] = std::max(felt_[c], most_felt(c));
    return {};
}

Result<void> SkinSilence::end(const SkinInput&, std::int64_t, std::span<const Spike> last) {
    for (const auto& s : last) fired_[skin_->afferents[s.afferent_index].class_index] = 1;
    return {};
}

std::vector<SilentClass> SkinSilence::found(Method method, bool sampled) const {
    std::vector<SilentClass> out;
    for (std::size_t c = 0; c < fired_.size(); ++c) {
        if (fired_[c] || skin_->class_begin[c + 1] == skin_->class_begin[c]) continue;
        out.push_back({c, felt_[c], {}});
        if (!(felt_[c] > 0 && largest_ > 0)) continue;
        auto force_on_afferent = course_;  // force on the afferent with the largest force
        for (auto& f : force_on_afferent) f *= felt_[c] / largest_;
        out.back().factor = factor_to_fire(skin_->plan.classes[c].afferent, {dt_, method, sampled, 0, 0}, force_on_afferent);
    }
    return out;
}

}  // namespace corpuscle
