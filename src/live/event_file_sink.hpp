#pragma once
// Writes events to a file in a separate thread, because a write to a disk may block, and the stream must not wait for it.

#include "live/event_sink.hpp"

namespace corpuscle {

/// Writes to the open descriptor `fd`, which stays open. `name` is for messages; `ring` is the size of the ring in bytes.
Result<std::unique_ptr<EventSink>> make_file_sink(int fd, const std::string& name, const EventFormat&, std::size_t ring);

}  // namespace corpuscle
