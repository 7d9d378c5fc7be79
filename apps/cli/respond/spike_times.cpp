#include "cli/respond/spike_times.hpp"

namespace corpuscle {

Result<void> SpikeTimes::begin(const Input& input) {
    input_name_ = input.name, is_skin_ = input.population.skin() != nullptr;
    for (std::size_t u = 0; u < input.population.size(); ++u)
        trains_.push_back({input.population.afferent_name(u), input.population.channel_name(u)});
    return {};
}

void SpikeTimes::add(const Input& input, std::span<const Spike> spikes) {
    count_ += spikes.size();
    if (is_over_limit()) return trains_.clear();
    for (const auto& s : spikes) trains_[s.afferent_index].times.push_back(input.clock.time(s.step, s.offset));
}

nlohmann::ordered_json SpikeTimes::document() const {
    if (is_over_limit()) return nullptr;
    auto out = nlohmann::ordered_json::array();
    for (const auto& train : trains_)
        if (!is_skin_ || !train.times.empty())
            out.push_back({{"afferent", train.afferent}, {"channel", train.channel}, {"times_s", train.times}});
    return out;
}

}  // namespace corpuscle
