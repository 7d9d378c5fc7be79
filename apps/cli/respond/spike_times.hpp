#pragma once
// Collects the spikes of every afferent for the JSON document on standard output.

#include <nlohmann/json.hpp>
#include <vector>

#include "run/sink.hpp"

namespace corpuscle {

class SpikeTimes final : public Sink {
    struct Train {
        std::string afferent, channel;
        std::vector<double> times = {};  // s, on the clock of the input
    };
    std::vector<Train> trains_;  // of all afferents of all inputs
    std::string input_name_;
    bool is_skin_ = false;
    std::size_t count_ = 0;  // spikes of all afferents

    void add(const Input&, std::span<const Spike>);

public:
    static constexpr std::size_t max_spikes = 10'000'000;  ///< of a skin; if there are more, document() is null

    Result<void> begin(const Input&) override;
    Result<void> block(const Input& input, const RunBlock& block) override { return add(input, block.spikes), Result<void>(); }
    Result<void> end(const Input& input, std::int64_t, std::span<const Spike> last) override { return add(input, last), Result<void>(); }
    /// True if a skin had more spikes than max_spikes.
    bool is_over_limit() const { return is_skin_ && count_ > max_spikes; }
    const std::string& input_name() const { return input_name_; }  ///< of the last input
    /// An array with afferent, channel and times_s of each afferent, of a skin only those that fired, named as in spikes.csv. null if there
    /// are too many spikes.
    nlohmann::ordered_json document() const;
};

}  // namespace corpuscle
