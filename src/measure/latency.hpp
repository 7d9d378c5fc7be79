#pragma once

#include <cmath>

#include "measure/measure_base.hpp"

namespace corpuscle {

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
