#pragma once
// The two binary event formats. Use make_event_format() to create a format by name.

#include "io/events.hpp"

namespace corpuscle {

std::unique_ptr<EventFormat> make_aer_format(const EventAddressing&);
std::unique_ptr<EventFormat> make_aedat2_format(const EventAddressing&);

}  // namespace corpuscle
