#pragma once
// What a column's heading says: its name, its unit, whether it is the time.

#include <optional>
#include <string_view>

#include "io/table.hpp"

namespace corpuscle {

/// The name and the unit in a header's field: "fz_N", "fz [N]", "fz (N)", "fz/N", "fz in N".
Column parse_heading(std::string_view field);

/// Is a column of this name the time, whatever else it may be? time, t, timestamp ...
bool names_time(std::string_view name);

/// May it be? unix_time, datetime, header.stamp, Zeit ...
bool may_name_time(std::string_view name);

/// Is it the number of the row? index, sample, frame, seq ...
bool names_index(std::string_view name);

/// Is it the number of a packet, which rises by any steps? RDTSequence, header.seq ...
bool names_sequence(std::string_view name);

/// Does it tell trials apart? trial, run, subject ...
bool names_trial(std::string_view name);

/// Is this word a unit, as one that stands under a heading? A letter that may mean something else counts, too.
bool is_unit(std::string_view word);

/// Seconds in a unit of time, as people write it: s, ms, sec, millis ...
std::optional<double> seconds_in(std::string_view unit);

/// A known unit that no reading of a force sensor has, in whatever way it is read: times, temperatures, angles, torques, speeds.
bool is_never_force(std::string_view unit);

}  // namespace corpuscle
