#pragma once

#include "measure/pauses.hpp"
#include "measure/rates.hpp"

namespace corpuscle {

/// Adaptation ratio: the first interspike interval of the phase divided by the last one, as in NeuroElectro (Tripathy et al. 2014, Front
/// Neuroinform 8:40). Both intervals are between two spikes of the phase; at least two are required. There is no value for a train whose
/// pauses are longer in total than its firing.
struct AdaptationRatio : MeasureBase {
    static constexpr MeasureInfo info{"adaptation_ratio", "adaptation", "", 2,
                                      "first interval of the phase divided by its last: 1 means no adaptation, 0.5 a slowing to half"};
    int intervals = 0;  // up to 2; more are not counted
    double first = 0, last = 0;
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
