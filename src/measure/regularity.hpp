#pragma once

#include <cmath>

#include "measure/pauses.hpp"
#include "measure/stretch.hpp"

namespace corpuscle {

/// Coefficient of variation of the interspike intervals (Softky & Koch 1993, J Neurosci 13:334): their standard deviation, of all
/// and not of a sample, over their mean. 0 is a clock, 1 a Poisson process. Needs two intervals; a train
/// whose pauses outlast its firing has none. Sums after Welford (1962).
struct IntervalVariation : Deaf {
    static constexpr Measure row{"isi_cv", "ISI CV", "", 2,
                                 "standard deviation of the intervals between the phase's spikes over their mean"};
    double count = 0, mean = 0, squares = 0;  // squares: of the distances from the mean
    Pauses pauses;
    void interval(double from, double to, bool inside) {
        if (!inside) return;
        pauses.add(to - from);
        const double x = to - from, off = x - mean;
        mean += off / ++count;
        squares += off * (x - mean);
    }
    double value(const Stretch&) const {
        return count >= 2 && mean > 0 && !pauses.outlast_firing() ? std::sqrt(squares / count) / mean : no_value;
    }
};

}  // namespace corpuscle
