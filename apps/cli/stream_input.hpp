#pragma once
// Opens the frame source of a stream from the options of the command line.

#include <memory>
#include <span>
#include <string>

#include "io/recording.hpp"
#include "live/byte_source.hpp"
#include "live/frame_layout.hpp"
#include "signal/parameter_override.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// True for a live input (-, tcp:PORT, udp:PORT, serial:DEVICE), false for a recording or a stimulus.
bool is_live_input(const std::string& in);
/// "standard input", "tcp:7000", "grip.csv"
std::string input_name(const std::string& in);

/// Quantities of the command line in SI: max_force in N, times in s, the buffer in bytes.
struct StreamQuantities {
    RecordingOptions recording;  ///< rate, scale, offset and unit apply to live frames, too
    double max_force = 0, hold = 0, max_gap = 0, buffer = 0, idle_timeout = 0;
};
Result<StreamQuantities> stream_quantities(const StreamArguments&);

/// Opens a recording, read as by respond, or a stimulus.
Result<std::unique_ptr<ForceSource>> open_stream_source(const StreamArguments&, const StreamQuantities&,
                                                        std::span<const ParameterOverride>);

/// The clock of live frames, and the layout of their bytes.
Result<Clock> live_clock(const StreamArguments&, const StreamQuantities&);
Result<FrameLayout> live_layout(const StreamArguments&, const StreamQuantities&, std::size_t sites, const Clock&);
Result<std::unique_ptr<ByteSource>> open_live_input(const StreamArguments&, const StreamQuantities&, const FrameLayout&);

}  // namespace corpuscle
