#pragma once
// Collects the spikes of a skin for the JSON document on standard output.

#include <nlohmann/json.hpp>
#include <vector>

#include "run/skin/skin_run.hpp"

namespace corpuscle {

class SkinSpikeTimes final : public SkinSink {
    std::vector<std::vector<double>> times_;         // s, on the clock of the force; one list for each afferent
    std::vector<std::string> afferents_, channels_;  // name and region of each afferent
    std::size_t count_ = 0;                          // spikes of all afferents

    void add(const Clock&, std::span<const Spike>);

public:
    static constexpr std::size_t max_spikes = 10'000'000;  ///< if there are more, document() is null

    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinRunBlock&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    /// True if there were more spikes than max_spikes.
    bool is_over_limit() const { return count_ > max_spikes; }
    /// An array with afferent, channel (the region) and times_s of each afferent that fired, named as in spikes.csv. null if there are too
    /// many spikes.
    nlohmann::ordered_json document() const;
};

}  // namespace corpuscle
