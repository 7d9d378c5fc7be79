#pragma once
// The interface of measures: the events that they receive, and their description.

#include <limits>
#include <string_view>

namespace corpuscle {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// The time window that is measured, [from, to) in s. `to` is infinite while the end is not known.
struct TimeWindow {
    double from = 0, to = std::numeric_limits<double>::infinity();  ///< s
    double stimulus_frequency = 0;                                  ///< Hz, of a periodic stimulus; 0: not periodic
};

/// Description of a measure. A measure is a struct with this as `info`. It implements those of the following functions that it needs:
///
///     spike(t, window)            each spike of the window, in order
///
///     interval(a, b, inside)      from each spike of the window to the next one; `inside` if that one is in the window as well
///
///     value(window)               at the end; no_value if it is undefined
struct MeasureInfo {
    std::string_view name;   ///< in files: "peak_rate"
    std::string_view title;  ///< for display: "peak"
    std::string_view unit;
    int decimals;  ///< decimal places for display; 0 for a count
    std::string_view description;
};

/// Base of measures: ignores all events.
struct MeasureBase {
    void spike(double, const TimeWindow&) {}
    void interval(double, double, bool) {}
};

}  // namespace corpuscle
