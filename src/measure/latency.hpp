#pragma once

#include <cmath>

#include "measure/measure_base.hpp"

namespace corpuscle {

/// First-spike latency (Johansson & Birznieks 2004, Nat Neurosci 7:170): from the start of the phase to its first spike. The published
/// measure refers to the phase in which the force begins.
struct Latency : MeasureBase {
    static constexpr MeasureInfo info{"latency", "latency", "s", 4, "from the phase's start to its first spike"};
    double first = no_value;
    void spike(double t, const TimeWindow&) {
        if (std::isnan(first)) first = t;
    }
    double value(const TimeWindow& s) const { return first - s.from; }
};

}  // namespace corpuscle
