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
bool is_wire(const std::string& in);
/// "standard input", "tcp:7000", "grip.csv"
std::string name_of_input(const std::string& in);

/// Quantities of the command line in SI. limit: N; hold, longest, idle: s; buffer: bytes.
struct StreamNumbers {
    RecordingOptions recording;  ///< rate, scale, offset and unit apply to live frames, too
    double limit = 0, hold = 0, longest = 0, buffer = 0, idle = 0;
};
Result<StreamNumbers> stream_numbers(const StreamWords&);

/// Opens a recording, read as by respond, or a stimulus.
Result<std::unique_ptr<ForceSource>> open_stream_source(const StreamWords&, const StreamNumbers&, std::span<const ParameterOverride>);

/// The clock of live frames, and their layout in the bytes.
Result<Clock> wire_clock(const StreamWords&, const StreamNumbers&);
Result<FrameLayout> wire_layout(const StreamWords&, const StreamNumbers&, std::size_t sites, const Clock&);
Result<std::unique_ptr<ByteSource>> open_wire(const StreamWords&, const StreamNumbers&, const FrameLayout&);

}  // namespace corpuscle
