#pragma once
// The two binary event formats, address events and AEDAT 2. Use make_event_format() in events.hpp to create a format by name.

#include "io/spikes/events.hpp"

namespace corpuscle {

std::unique_ptr<EventFormat> make_aer_format(const EventAddressing&);
std::unique_ptr<EventFormat> make_aedat2_format(const EventAddressing&);

}  // namespace corpuscle
