#pragma once

#include <cmath>

#include "measure/measure_base.hpp"
#include "measure/pauses.hpp"

namespace corpuscle {

/// Coefficient of variation of the interspike intervals (Softky & Koch 1993, J Neurosci 13:334): their population standard deviation
/// divided by their mean. It is 0 for equal intervals and 1 for a Poisson process. Pauses count as intervals. The value is undefined for
/// fewer than two intervals, and if the pauses last longer in total than the other intervals. The sums are updated as in Welford (1962).
struct IntervalVariation : MeasureBase {
    static constexpr MeasureInfo info{"isi_cv", "ISI CV", "", 2,
                                      "standard deviation of the interspike intervals of the phase divided by their mean"};
    double count = 0;    // number of intervals
    double mean = 0;     // s
    double squares = 0;  // sum of the squared deviations from the mean, s^2
    PauseDetector pauses;
    void interval(double from, double to, bool inside) {
        if (!inside) return;
        pauses.add(to - from);
        const double x = to - from, deviation = x - mean;
        mean += deviation / ++count;
        squares += deviation * (x - mean);
    }
    double value(const TimeWindow&) const {
        return count >= 2 && mean > 0 && !pauses.outlast_firing() ? std::sqrt(squares / count) / mean : no_value;
    }
};

}  // namespace corpuscle
