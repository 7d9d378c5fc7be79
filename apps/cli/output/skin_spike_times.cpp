#include "cli/output/skin_spike_times.hpp"

namespace corpuscle {

Result<void> SkinSpikeTimes::begin(const SkinInput& input) {
    const auto& skin = input.skin;
    times_.assign(skin.afferents.size(), {});
    for (std::size_t u = 0; u < skin.afferents.size(); ++u) {
        afferents_.push_back(skin.afferent_name(u));
        channels_.push_back(skin.plan.sites.regions[skin.afferents[u].region]);
    }
    return {};
}

void SkinSpikeTimes::add(const Clock& clock, std::span<const Spike> spikes) {
    count_ += spikes.size();
    if (is_over_limit()) return times_.clear();
    for (const auto& s : spikes) times_[s.afferent_index].push_back(clock.time(s.step, s.offset));
}

Result<void> SkinSpikeTimes::block(const SkinInput& input, const SkinRunBlock& response) {
    return add(input.clock, response.spikes), Result<void>();
}

Result<void> SkinSpikeTimes::end(const SkinInput& input, std::int64_t, std::span<const Spike> last) {
    return add(input.clock, last), Result<void>();
}

nlohmann::ordered_json SkinSpikeTimes::document() const {
    if (is_over_limit()) return nullptr;
    auto trains = nlohmann::ordered_json::array();
    for (std::size_t u = 0; u < times_.size(); ++u)
        if (!times_[u].empty()) trains.push_back({{"afferent", afferents_[u]}, {"channel", channels_[u]}, {"times_s", times_[u]}});
    return trains;
}

}  // namespace corpuscle
