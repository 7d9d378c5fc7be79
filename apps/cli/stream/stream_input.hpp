#pragma once
// Opens the frame source of a stream from the options of the command line.

#include <memory>
#include <span>
#include <string>

#include "cli/stream/stream_arguments.hpp"
#include "core/parameter_override.hpp"
#include "io/quality/filters.hpp"
#include "io/recording/recording.hpp"
#include "live/input/byte_source.hpp"
#include "live/input/frame_layout.hpp"
#include "live/input/frame_source.hpp"

namespace corpuscle {

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

}  // namespace corpuscle
