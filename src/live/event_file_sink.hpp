#pragma once
// Writes events to a file in a separate thread, because a disk may block the writer.

#include "live/event_sink.hpp"

namespace corpuscle {

/// A descriptor that may block, written directly.
Result<std::unique_ptr<EventSink>> make_file_sink(int fd, const std::string& name, const EventFormat&, std::size_t ring);

}  // namespace corpuscle
