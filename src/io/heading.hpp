#pragma once
// Interprets column headings: name, unit, and role.

#include <optional>
#include <string_view>

#include "io/table.hpp"

namespace corpuscle {

/// Splits a header field into name and unit: "fz_N", "fz [N]", "fz (N)", "fz/N", "fz in N".
Column parse_heading(std::string_view field);

/// True if a column of this name is certainly the time: time, t, timestamp ...
bool is_time_name(std::string_view name);

/// True if a column of this name may be the time: unix_time, datetime, header.stamp, Zeit ...
bool may_be_time_name(std::string_view name);

/// True if the name stands for a row number: index, sample, frame, seq ...
bool is_index_name(std::string_view name);

/// True if the name stands for a packet number, which increases in steps of any size: RDTSequence, header.seq ...
bool is_sequence_name(std::string_view name);

/// True if the name stands for a trial number or label: trial, run, subject ...
bool is_trial_name(std::string_view name);

/// True if the word is a unit, as in a row of units under the header. Ambiguous single letters count as units.
bool is_unit(std::string_view word);

/// The length in seconds of a time unit as people write it: s, ms, sec, millis ...
std::optional<double> seconds_per_time_unit(std::string_view unit);

/// True for units that a force sensor never has: times, temperatures, angles, torques, speeds.
bool is_never_force(std::string_view unit);

}  // namespace corpuscle
