#pragma once
// Dates and times of day as text: ISO 8601 and similar formats of loggers.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace corpuscle {

/// A date and time of day, or a time of day alone. It is in UTC if the text states a time zone, otherwise in the unknown zone of the text.
struct TimeStamp {
    std::int64_t day = 0;          ///< days since 1970-01-01; without a date only for differences, see seconds_between()
    std::int64_t nanoseconds = 0;  ///< since midnight
    bool has_date = false;         ///< false: a time of day alone
};

/// Parses "2026-03-01T12:00:00.000Z", "2026-03-01 12:00:00,5", "2026/03/01 12:00:00", "01.03.2026 12:00:00", "12:00:00.000". The
/// seconds are required, the date and the time zone (Z, +01:00) optional. 03/01/2026 is not accepted, because day and month are ambiguous.
std::optional<TimeStamp> parse_time_stamp(std::string_view text);

/// True for a date without a time: "2026-03-01".
bool is_date(std::string_view text);

/// The time from `from` to `to` in seconds. Exact to the nanosecond for differences of up to several months.
double seconds_between(const TimeStamp& from, const TimeStamp& to);

/// Formats seconds since 1970 as "2026-03-01 12:00:00.000", in UTC, to the millisecond.
std::string format_instant(double seconds_since_1970);

/// The note that 0 s is this time stamp, the first in the time column of this name.
std::string origin_note(const TimeStamp&, const std::string& column);

}  // namespace corpuscle
