#pragma once
// Numbers of spikes, firing rates, and the latency of the first spike.

#include "measure/intervals.hpp"

namespace corpuscle {

/// The instantaneous frequency in Hz at a spike at time `from`, if the next spike is at time `to` (both in s): one over the interval, as in
/// section 3.3 of the thesis. no_value if both are at the same time.
inline double rate_between(double from, double to) { return to > from ? 1 / (to - from) : no_value; }
/// The same, but no_value if the interval is longer than PauseDetector::max_interval.
inline double firing_rate_between(double from, double to) {
    return to - from > PauseDetector::max_interval ? no_value : rate_between(from, to);
}

struct SpikeCount : MeasureBase {
    static constexpr MeasureInfo info{"spikes", "spikes", "", 0, "spikes in the phase"};
    double count = 0;
    void spike(double, const TimeWindow&) { ++count; }
    double value(const TimeWindow&) const { return count; }
};

struct MeanRate : SpikeCount {
    static constexpr MeasureInfo info{"mean_rate", "mean", "Hz", 1, "spikes in the phase divided by its length"};
    double value(const TimeWindow& window) const { return window.to > window.from ? count / (window.to - window.from) : no_value; }
};

struct PeakRate : MeasureBase {
    static constexpr MeasureInfo info{"peak_rate", "peak", "Hz", 1, "highest instantaneous frequency at a spike of the phase"};
    double peak = no_value;  // Hz
    void interval(double from, double to, bool) {
        if (const double rate = firing_rate_between(from, to); rate > peak || std::isnan(peak)) peak = rate;
    }
    double value(const TimeWindow&) const { return peak; }
};

struct FirstRate : MeasureBase {
    static constexpr MeasureInfo info{"first_rate", "first", "Hz", 1, "instantaneous frequency at the phase's first spike"};
    bool has_interval = false;  // true after the first interval, even if that has no rate
    double first = no_value;    // Hz
    void interval(double from, double to, bool) {
        if (!has_interval) first = firing_rate_between(from, to);
        has_interval = true;
    }
    double value(const TimeWindow&) const { return first; }
};

struct LastRate : MeasureBase {
    static constexpr MeasureInfo info{"last_rate", "last", "Hz", 1, "last instantaneous frequency between two spikes of the phase"};
    double last = no_value;  // Hz; no_value if the latest interval is a pause
    PauseDetector pauses;
    void interval(double from, double to, bool inside) {
        if (inside) last = pauses.add(to - from) ? no_value : rate_between(from, to);
    }
    double value(const TimeWindow&) const { return last; }
};

/// First-spike latency: the time from the start of the phase to its first spike. Johansson & Birznieks (2004, Nat Neurosci 7:170) define it
/// for the phase in which the force begins.
struct Latency : MeasureBase {
    static constexpr MeasureInfo info{"latency", "latency", "s", 4, "from the phase's start to its first spike"};
    double first = no_value;  // time of the first spike, s; no_value: no spike so far
    void spike(double t, const TimeWindow&) {
        if (std::isnan(first)) first = t;
    }
    double value(const TimeWindow& window) const { return first - window.from; }
};

}  // namespace corpuscle
