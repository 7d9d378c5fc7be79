#pragma once
// Events to a file: a disk may make a writer wait, so a thread of its own takes them out of the ring.

#include "live/event_outlet.hpp"

namespace corpuscle {

/// A descriptor that may wait, written as it is.
Result<std::unique_ptr<EventOutlet>> plain_file_outlet(int fd, const std::string& name, const EventFormat&, std::size_t ring);

}  // namespace corpuscle
