#include "io/text/time_stamp.hpp"

#include <fmt/format.h>
#include <chrono>
#include <cmath>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000, day_ns = 86'400 * second_ns;  // a second and a day in ns

/// Parses the parts of a time stamp from the front of a text. `valid` becomes false if a required part is missing.
struct StampReader {
    std::string_view rest;
    bool valid = true;

    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    /// Reads at least `min_count` and at most `max_count` digits, and returns the number that they form.
    int digits(std::size_t min_count, std::size_t max_count) {
        std::size_t n = 0;
        int value = 0;
        while (n < max_count && n < rest.size() && is_digit(rest[n])) value = value * 10 + (rest[n++] - '0');
        valid = valid && n >= min_count;
        rest.remove_prefix(n);
        return value;
    }
    /// Moves past c if it comes next. Returns false if it does not.
    bool accept(char c) {
        if (!rest.starts_with(c)) return false;
        return rest.remove_prefix(1), true;
    }
    /// Like accept(), but c is required.
    void expect(char c) { valid = accept(c) && valid; }
};

/// Days from 1970-01-01 to a date; nullopt if the date does not exist.
std::optional<std::int64_t> day_of(int year, int month, int day) {
    namespace c = std::chrono;
    const c::year_month_day date{c::year(year), c::month(static_cast<unsigned>(month)), c::day(static_cast<unsigned>(day))};
    if (!date.ok() || year < 1) return {};
    return c::sys_days(date).time_since_epoch().count();
}

/// Parses "2026-03-01", "2026/03/01" or "01.03.2026" to days since 1970-01-01. If no date comes next, returns nullopt and leaves `in`
/// unchanged.
std::optional<std::int64_t> parse_date(StampReader& in) {
    StampReader r = in;
    const std::size_t digits = std::min(r.rest.find_first_not_of("0123456789"), r.rest.size());
    std::optional<std::int64_t> day;
    if (digits == 4) {
        const int year = r.digits(4, 4);
        const char separator = r.rest.starts_with('/') ? '/' : '-';
        r.expect(separator);
        const int month = r.digits(1, 2);
        r.expect(separator);
        day = day_of(year, month, r.digits(1, 2));
    } else if (digits <= 2 && r.rest.substr(digits).starts_with('.')) {
        const int first = r.digits(1, 2);  // the day of the month
        r.expect('.');
        const int month = r.digits(1, 2);
        r.expect('.');
        day = day_of(r.digits(4, 4), month, first);
    }
    if (!day || !r.valid) return {};
    in = r;
    return day;
}

/// Parses "12:00:00.125" to nanoseconds since midnight.
std::optional<std::int64_t> parse_time_of_day(StampReader& r) {
    const int hour = r.digits(1, 2);
    r.expect(':');
    const int minute = r.digits(2, 2);
    r.expect(':');
    const int second = r.digits(2, 2);
    if (!r.valid || hour > 23 || minute > 59 || second > 60) return {};
    std::int64_t fraction = 0;
    if (r.accept('.') || r.accept(',') || r.accept(':')) {  // some loggers write a colon before the milliseconds
        std::int64_t unit = second_ns;                      // value of the last decimal place read
        while (!r.rest.empty() && StampReader::is_digit(r.rest[0])) {
            if (unit > 1) fraction += (unit /= 10) * (r.rest[0] - '0');
            r.rest.remove_prefix(1);
        }
        if (unit == second_ns) return {};
    }
    return (hour * 3600LL + minute * 60LL + second) * second_ns + fraction;
}

/// Parses the time zone "Z", "+01:00", "+0100" or "+01" to nanoseconds ahead of UTC; 0 if there is none, nullopt if it is invalid.
std::optional<std::int64_t> parse_zone(StampReader& r) {
    if (r.accept('Z') || r.accept('z')) return 0;
    const bool west = r.rest.starts_with('-');
    if (!west && !r.rest.starts_with('+')) return 0;
    r.rest.remove_prefix(1);
    const int hours = r.digits(2, 2);
    r.accept(':');
    const int minutes = r.rest.empty() ? 0 : r.digits(2, 2);
    if (!r.valid || hours > 14 || minutes > 59) return {};
    const std::int64_t offset = (hours * 3600LL + minutes * 60LL) * second_ns;
    return west ? -offset : offset;
}

}  // namespace

std::optional<TimeStamp> parse_time_stamp(std::string_view text) {
    StampReader r{trimmed(text)};
    const auto day = parse_date(r);
    if (day && !r.accept('T') && !r.accept('t') && !r.accept(' ') && !r.accept('-') && !r.accept('_')) return {};
    r.rest = trimmed(r.rest);
    const auto time = parse_time_of_day(r);
    if (!time) return {};
    r.rest = trimmed(r.rest);
    if (r.rest == "UTC") r.rest = {};
    const auto offset = parse_zone(r);
    if (!offset || !r.rest.empty()) return {};
    TimeStamp out{day.value_or(0), *time - *offset, day.has_value()};
    for (; out.nanoseconds < 0; out.nanoseconds += day_ns) --out.day;
    for (; out.nanoseconds >= day_ns; out.nanoseconds -= day_ns) ++out.day;
    return out;
}

bool is_date(std::string_view text) {
    StampReader r{trimmed(text)};
    return parse_date(r) && r.rest.empty();
}

double seconds_between(const TimeStamp& from, const TimeStamp& to) {
    const double days = static_cast<double>(to.day - from.day);
    // In this range the difference in nanoseconds fits into 64 bits.
    if (std::abs(days) < 1e5) return static_cast<double>((to.day - from.day) * day_ns + (to.nanoseconds - from.nanoseconds)) / 1e9;
    return days * 86'400 + static_cast<double>(to.nanoseconds - from.nanoseconds) / 1e9;
}

std::string format_instant(double seconds_since_1970) {
    namespace c = std::chrono;
    if (!(std::abs(seconds_since_1970) < 1e11)) return fmt::format("{:g} s", seconds_since_1970);
    const auto milliseconds = static_cast<std::int64_t>(std::floor(seconds_since_1970 * 1e3 + 0.5));
    std::int64_t day = milliseconds / 86'400'000, left = milliseconds % 86'400'000;
    if (left < 0) left += 86'400'000, --day;
    const c::year_month_day date{c::sys_days(c::days(day))};
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}.{:03}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                       static_cast<unsigned>(date.day()), left / 3'600'000, left / 60'000 % 60, left / 1000 % 60, left % 1000);
}

std::string origin_note(const TimeStamp& s, const std::string& column) {
    const auto instant = format_instant(static_cast<double>(s.day) * 86'400 + static_cast<double>(s.nanoseconds) * 1e-9);
    return fmt::format("0 s is {}, the first time in '{}'", s.has_date ? instant : instant.substr(11), column);
}

}  // namespace corpuscle
