#pragma once
// What every measure is told, and what it says of itself.

#include <limits>
#include <string_view>

namespace corpuscle {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// The stretch of time that is measured, [from, to) in s. While spikes come, `to` may not be known yet: infinite.
struct Stretch {
    double from = 0, to = std::numeric_limits<double>::infinity();
    double cycle = 0;  ///< Hz, of a stimulus that repeats itself; 0 if it does not
};

/// A measure in words. Its struct says this as `row`, and takes what it needs of:
///     spike(t, stretch)            each spike of the stretch, in order
///     interval(a, b, inside)       from each spike of the stretch to the next one; inside: that is in the stretch, too
///     value(stretch)               at the end; no_value where it has no meaning
struct Measure {
    std::string_view name;   ///< in files: "peak_rate"
    std::string_view title;  ///< for people: "peak"
    std::string_view unit;
    int decimals;  ///< that tell something; 0 is a count
    std::string_view sentence;
};

/// What a measure does not ask for.
struct Deaf {
    void spike(double, const Stretch&) {}
    void interval(double, double, bool) {}
};

}  // namespace corpuscle
