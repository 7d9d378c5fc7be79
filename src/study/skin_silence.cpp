#include "study/skin_silence.hpp"

#include <algorithm>

#include "study/silence.hpp"

namespace corpuscle {

Result<void> SkinSilence::begin(const SkinInput& input) {
    skin_ = &input.skin, dt_ = input.clock.T(), largest_ = 0;
    fired_.assign(skin_->plan.classes.size(), 0), felt_.assign(fired_.size(), 0);
    peak_.assign(skin_->plan.sites.size(), 0), of_unit_.assign(skin_->units.size(), 0);
    course_.clear();
    return {};
}

/// The sites with force, and how much each has at most.
void SkinSilence::find_peaks(const SkinAnswered& answered) {
    touched_.clear();
    const auto add = [&](std::uint32_t site) {
        const double* force = answered.force.of + site * answered.force.stride;
        const double most = *std::max_element(force, force + answered.steps);
        if (most > 0) peak_[site] = most, touched_.push_back(site);
    };
    for (std::uint32_t s = 0; answered.force.all && s < peak_.size(); ++s) add(s);
    for (const auto s : answered.force.touched)
        if (!answered.force.all) add(s);
}

double SkinSilence::most_felt(std::size_t of) {
    const auto& fields = skin_->fields[of];
    double most = 0;
    for (const auto s : touched_)
        for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k)
            most = std::max(most, of_unit_[fields.unit[k]] += fields.weight[k] * peak_[s]);
    for (const auto s : touched_)
        for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k) of_unit_[fields.unit[k]] = 0;
    return most;
}

Result<void> SkinSilence::block(const SkinInput&, const SkinAnswered& answered) {
    for (const auto& s : answered.spikes) fired_[skin_->units[s.unit].of] = 1;
    if (std::find(fired_.begin(), fired_.end(), 0) == fired_.end() || answered.steps == 0) return {};
    const auto room = most_silent_samples - std::min(most_silent_samples, course_.size());
    course_.insert(course_.end(), answered.total.begin(),
                   answered.total.begin() + static_cast<std::ptrdiff_t>(std::min(room, answered.steps)));
    largest_ = std::max(largest_, *std::max_element(answered.total.begin(), answered.total.end()));
    find_peaks(answered);
    for (std::size_t c = 0; c < fired_.size(); ++c)
        if (!fired_[c]) felt_[c] = std::max(felt_[c], most_felt(c));
    return {};
}

Result<void> SkinSilence::end(const SkinInput&, std::int64_t, std::span<const Spike> last) {
    for (const auto& s : last) fired_[skin_->units[s.unit].of] = 1;
    return {};
}

std::vector<SilentClass> SkinSilence::found(Method method, bool sampled) const {
    std::vector<SilentClass> out;
    for (std::size_t c = 0; c < fired_.size(); ++c) {
        if (fired_[c] || skin_->first[c + 1] == skin_->first[c]) continue;
        out.push_back({c, felt_[c], {}});
        if (!(felt_[c] > 0 && largest_ > 0)) continue;
        auto felt = course_;  // as the unit that felt most felt it
        for (auto& f : felt) f *= felt_[c] / largest_;
        out.back().factor = factor_to_fire(skin_->plan.classes[c].afferent, {dt_, method, sampled, 0, 0}, felt);
    }
    return out;
}

}  // namespace corpuscle
