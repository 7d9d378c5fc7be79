#pragma once
// The arguments of `corpuscle stream`, and the function that runs it.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/arguments/recording_arguments.hpp"

namespace corpuscle {

struct StreamArguments {
    std::string population = "sa1,fa1", in = "-", listen = "127.0.0.1", frames = "csv", stamp = "none", pace = "real";
    std::vector<ParameterOverride> settings;
    RecordingOptions recording;                          ///< live_options.hpp says which of them apply to live frames
    double max_force = 1e3;                              ///< N
    double hold = 0.1, max_gap = 10, idle_timeout = 10;  ///< s
    double buffer = 1e6;                                 ///< bytes
    std::string out = "-", to, format = "lines", save_state, resume;
    std::uint64_t channel_count = 1;  ///< forces per frame, if `population` is a list of afferents
    std::uint64_t batch_frames = 1;   ///< frames per batch
    std::int64_t clients = 0;         ///< number of senders, one after another, after which the stream ends; 0: unlimited
    std::int64_t baud = 115200;
    bool sampled = false, busy_poll = false, allow_drops = false;
};

/// Runs one live stream until its input ends: opens input, skin and output, simulates, and prints a summary. If it is interrupted, which is
/// an error, the summary has been printed.
Result<void> run_live(const StreamArguments&, const CommonArguments&);

}  // namespace corpuscle
