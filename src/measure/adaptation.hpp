#pragma once

#include "measure/pauses.hpp"
#include "measure/rates.hpp"

namespace corpuscle {

/// Adaptation ratio: the first interspike interval of the phase divided by the last one, as in NeuroElectro (Tripathy et al. 2014, Front
/// Neuroinform 8:40). Both spikes of an interval must be in the phase, and pauses do not count as intervals. The ratio is undefined for
/// fewer than two intervals, and if the pauses last longer in total than the other intervals.
struct AdaptationRatio : MeasureBase {
    static constexpr MeasureInfo info{"adaptation_ratio", "adaptation", "", 2,
                                      "first interval of the phase divided by its last: 1 means no adaptation, 0.5 a slowing to half"};
    int intervals = 0;           // number of intervals so far, but not more than 2
    double first = 0, last = 0;  // lengths of the first and the latest interval, s
    PauseDetector pauses;
    void interval(double from, double to, bool inside) {
        if (!inside || pauses.add(to - from)) return;
        last = to - from;
        if (intervals == 0) first = last;
        if (intervals < 2) ++intervals;
    }
    double value(const TimeWindow&) const { return intervals == 2 && last > 0 && !pauses.outlast_firing() ? first / last : no_value; }
};

}  // namespace corpuscle
