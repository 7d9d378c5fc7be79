#pragma once
// The arguments of `corpuscle stream`.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/arguments/recording_arguments.hpp"

namespace corpuscle {

struct StreamArguments : RecordingArguments {
    std::string population = "sa1,fa1", in = "-", listen = "127.0.0.1", frames = "csv", stamp = "none", pace = "real";
    std::vector<std::string> settings;
    std::string max_force = "1kN", hold = "100ms", max_gap = "10s", buffer = "1M", idle_timeout = "10s";
    std::string out = "-", to, format = "lines", save_state, resume;
    std::uint64_t channel_count = 1;  ///< forces per frame, if `population` is a list of afferents
    std::uint64_t batch_frames = 1;   ///< frames per batch
    std::int64_t clients = 0;         ///< number of senders, one after another, after which the stream ends; 0: unlimited
    std::int64_t baud = 115200;
    bool sampled = false, busy_poll = false, allow_drops = false;
};

}  // namespace corpuscle
