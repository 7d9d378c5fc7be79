#pragma once
// Writes events to a file in a separate thread, because a write to a disk may take long, and the stream must not wait for it.

#include "live/output/event_sink.hpp"

namespace corpuscle {

/// A sink that writes to the open descriptor `fd` of a file, and does not close it. `name` is for messages; `ring` is the size of the ring
/// buffer in bytes.
Result<std::unique_ptr<EventSink>> make_file_sink(int fd, const std::string& name, const EventFormat&, std::size_t ring);

}  // namespace corpuscle
