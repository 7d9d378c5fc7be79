#pragma once
// The two binary formats of events, made by event_format().

#include "io/events.hpp"

namespace corpuscle {

std::unique_ptr<EventFormat> aer_events(const EventUnits&);
std::unique_ptr<EventFormat> aedat2_events(const EventUnits&);

}  // namespace corpuscle
