#pragma once
// The interface of measures: the events that they receive, and their description.

#include <limits>
#include <string_view>

namespace corpuscle {

/// The value of a measure that is undefined.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// The time window [from, to) that is measured, usually a phase of the stimulus. `to` is infinite while the end is not known.
struct TimeWindow {
    double from = 0, to = std::numeric_limits<double>::infinity();  ///< s, in the time of the spikes
    double stimulus_frequency = 0;                                  ///< Hz; 0: the stimulus is not periodic
};

/// Description of a measure. A measure is a struct derived from MeasureBase with a static member `info` of this type. One object of it
/// measures one train in one window. It implements those of the following functions that it needs; times are in s:
///
///     spike(t, window)            called for each spike in the window, in order of time
///
///     interval(from, to, inside)  called for each spike in the window that has a next spike, with the times of both; `inside` is true
///                                 if the next spike is in the window as well
///
///     value(window)               returns the value after the last spike, or no_value if it is undefined
struct MeasureInfo {
    std::string_view name;   ///< in files, as a key or column: "peak_rate"
    std::string_view title;  ///< on pages and in tables: "peak"
    std::string_view unit;
    int decimals;  ///< decimal places when displayed; 0 for a count
    std::string_view description;
};

/// Base of measures: ignores all events.
struct MeasureBase {
    void spike(double, const TimeWindow&) {}
    void interval(double, double, bool) {}
};

}  // namespace corpuscle
