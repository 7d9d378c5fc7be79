#pragma once

#include "measure/pauses.hpp"
#include "measure/rates.hpp"

namespace corpuscle {

/// Adaptation ratio: the first interspike interval of the phase over its last, both between two of its spikes (early over late,
/// as NeuroElectro collects it; Tripathy et al. 2014, Front Neuroinform 8:40). Needs two intervals; a train whose pauses outlast its
/// firing has none.
struct AdaptationRatio : Deaf {
    static constexpr Measure row{"adaptation_ratio", "adaptation", "", 2,
                                 "first interval of the phase over its last: 1 does not adapt, 0.5 has slowed to half"};
    int intervals = 0;  // up to 2: more need no counting
    double first = 0, last = 0;
    Pauses pauses;
    void interval(double from, double to, bool inside) {
        if (!inside || pauses.add(to - from)) return;
        last = to - from;
        if (intervals == 0) first = last;
        if (intervals < 2) ++intervals;
    }
    double value(const Stretch&) const { return intervals == 2 && last > 0 && !pauses.outlast_firing() ? first / last : no_value; }
};

}  // namespace corpuscle
