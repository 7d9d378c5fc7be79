#pragma once

#include <cmath>

#include "measure/measure_base.hpp"

namespace corpuscle {

struct LongestInterval : MeasureBase {
    static constexpr MeasureInfo info{"longest_interval", "longest", "s", 4, "longest interval between two spikes of the phase"};
    double longest = no_value;  // s
    void interval(double from, double to, bool inside) {
        if (inside && !(to - from <= longest)) longest = to - from;
    }
    double value(const TimeWindow&) const { return longest; }
};

}  // namespace corpuscle
