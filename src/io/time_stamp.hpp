#pragma once
// Dates and times of day as text: ISO 8601 and what loggers write like it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace corpuscle {

/// An instant. Without a date it lies on day 0 of an unknown count.
struct TimeStamp {
    std::int64_t day = 0;          ///< since 1970-01-01, of universal time if a zone is given
    std::int64_t nanoseconds = 0;  ///< of the day
    bool dated = false;
};

/// "2026-03-01T12:00:00.000Z", "2026-03-01 12:00:00,5", "2026/03/01 12:00:00", "01.03.2026 12:00:00", "12:00:00.000": a time of day to
/// the second or finer, with a date before it or none, and a zone behind it (Z, +01:00) or none. Not 03/01/2026: which is the month?
std::optional<TimeStamp> parse_time_stamp(std::string_view text);

/// "2026-03-01" alone.
bool is_date(std::string_view text);

/// The seconds from one to another, to the nanosecond within months.
double seconds_between(const TimeStamp& from, const TimeStamp& to);

/// "2026-03-01 12:00:00.000": seconds since 1970 in universal time, to the millisecond.
std::string format_instant(double seconds_since_1970);

}  // namespace corpuscle
