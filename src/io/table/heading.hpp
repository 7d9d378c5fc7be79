#pragma once
// Interprets the headings of columns: name, unit, and whether a column is a time, a row number or a trial number.

#include <string_view>

#include "io/table/table.hpp"

namespace corpuscle {

/// Splits a header field, as written in the file, into name and unit: "fz_N", "fz [N]", "fz (N)", "fz/N", "fz in N".
Column parse_heading(std::string_view written);

/// True if a column of this name is certainly the time: time, t, timestamp ...
bool is_time_name(std::string_view name);

/// True if a column of this name may be the time, including the names above: unix_time, datetime, header.stamp, Zeit ...
bool may_be_time_name(std::string_view name);

/// True if the name stands for a row number: index, sample, frame, seq ...
bool is_index_name(std::string_view name);

/// True if the name stands for a packet number, which increases by more than 1 where packets are missing: RDTSequence, header.seq ...
bool is_sequence_name(std::string_view name);

/// True if the name stands for a trial number or label: trial, run, subject ...
bool is_trial_name(std::string_view name);

/// True if the word is a unit, as in a row of units below the headings. Single letters that may also be names, such as F, count as units.
bool is_unit(std::string_view word);

/// The length in seconds of a unit of time: s, ms, sec, millis ... nullopt if `unit` is not a unit of time.
std::optional<double> seconds_per_time_unit(std::string_view unit);

/// True for units that a force sensor never has: of time, frequency, temperature, angle, torque, speed or acceleration.
bool is_never_force(std::string_view unit);

}  // namespace corpuscle
