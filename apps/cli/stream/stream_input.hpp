#pragma once
// The arguments of `corpuscle stream`, the frame source that they describe, and the function that runs the stream.

#include <memory>
#include <span>
#include <string>

#include "cli/arguments/force_arguments.hpp"
#include "core/parameter_override.hpp"
#include "io/quality/biquad.hpp"
#include "io/recording/recording.hpp"
#include "live/input/byte_source.hpp"
#include "live/input/frame_layout.hpp"
#include "live/input/frame_source.hpp"

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

/// True for a live input (-, tcp:PORT, udp:PORT, serial:DEVICE), false for a recording or a stimulus.
bool is_live_input(const std::string& in);
/// The name of an input in messages: "standard input" for "-", otherwise as typed, such as "tcp:7000" or "grip.csv".
std::string input_name(const std::string& in);

/// Opens the recording, read as by `respond`, or the stimulus of --in.
Result<Applied<std::unique_ptr<ForceSource>>> open_stream_source(const StreamArguments&, const CommonArguments&);

/// Returns an error, with the reason, if a recording option was given that live frames cannot have.
Result<void> check_live_options(const StreamArguments&, const CommonArguments&);
/// The clock of live frames.
Result<Clock> live_clock(const StreamArguments&);
/// The layout of live frames. `sites`: number of forces in a frame.
Result<FrameLayout> live_layout(const StreamArguments&, std::size_t sites, const Clock&);
/// The filters of --notch and --lowpass.
Result<std::vector<Biquad>> live_filters(const RecordingOptions&, const Clock&);
/// Opens a live input: standard input, a port or a serial device.
Result<std::unique_ptr<ByteSource>> open_live_input(const StreamArguments&, const FrameLayout&);

/// Runs one live stream until its input ends: opens input, skin and output, simulates, and prints a summary. If it is interrupted, which is
/// an error, the summary has been printed.
Result<void> run_live(const StreamArguments&, const CommonArguments&);

}  // namespace corpuscle
