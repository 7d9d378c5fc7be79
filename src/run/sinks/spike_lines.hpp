#pragma once
// The text of spikes.csv.

#include "core/spike.hpp"
#include "core/text/fixed_number.hpp"

namespace corpuscle {

inline constexpr std::string_view spike_lines_heading = "afferent,channel,time_s\n";

/// Appends the line of a spike: its time to the nanosecond. `names`: of afferent and channel, as two CSV fields.
inline void append_spike_line(fmt::memory_buffer& text, std::string_view names, const Spike& s, const Clock& clock) {
    text.append(names.data(), names.data() + names.size());
    text.push_back(',');
    append_fixed(text, clock.time(s.step, s.offset), 9);
    text.push_back('\n');
}

}  // namespace corpuscle
