#pragma once
// The two binary event formats. Use make_event_format() to create a format by name.

#include "io/events.hpp"

namespace corpuscle {

std::unique_ptr<EventFormat> aer_events(const EventUnits&);
std::unique_ptr<EventFormat> aedat2_events(const EventUnits&);

}  // namespace corpuscle
