#pragma once
// Dates and times of day as text: ISO 8601 and similar formats of loggers.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace corpuscle {

/// A point in time. Without a date, the day is 0 and has no meaning.
struct TimeStamp {
    std::int64_t day = 0;          ///< days since 1970-01-01, in UTC if a time zone is given
    std::int64_t nanoseconds = 0;  ///< since the start of the day
    bool has_date = false;
};

/// Parses "2026-03-01T12:00:00.000Z", "2026-03-01 12:00:00,5", "2026/03/01 12:00:00", "01.03.2026 12:00:00", "12:00:00.000". The
/// seconds are required, the date and the time zone (Z, +01:00) optional. 03/01/2026 is not accepted, because day and month are ambiguous.
std::optional<TimeStamp> parse_time_stamp(std::string_view text);

/// True for a date without a time: "2026-03-01".
bool is_date(std::string_view text);

/// The difference in seconds. Exact to the nanosecond for differences of months.
double seconds_between(const TimeStamp& from, const TimeStamp& to);

/// Formats seconds since 1970 as "2026-03-01 12:00:00.000", in UTC, to the millisecond.
std::string format_instant(double seconds_since_1970);

}  // namespace corpuscle
