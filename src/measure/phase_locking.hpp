#pragma once
// Phase locking of spikes to a periodic stimulus, over the complete stimulus cycles of a time window, counted from its start.

#include <cmath>

#include "measure/measure_base.hpp"
#include "signal/elementary.hpp"

namespace corpuscle {

/// The spikes of a cycle are added to the sum only when the next cycle begins, because the last cycle may be incomplete and is then not
/// counted.
template <class Sum>
struct CycleMeasure : MeasureBase {
    double cycle = -1;  // index of the current cycle
    Sum current{}, sum{};

    void spike(double t, const TimeWindow& s) {
        if (!(s.stimulus_frequency > 0)) return;
        const double cycles_elapsed = (t - s.from) * s.stimulus_frequency;
        if (std::floor(cycles_elapsed) != cycle) sum.add(current), current = {}, cycle = std::floor(cycles_elapsed);
        current.spike(cycles_elapsed);
    }
    /// The number of complete cycles. The factor keeps a cycle that rounding would make incomplete.
    static double cycles(const TimeWindow& s) { return std::floor((s.to - s.from) * s.stimulus_frequency * (1 + 1e-12)); }
    /// The sum over the complete cycles.
    Sum complete(const TimeWindow& s) const {
        Sum all = sum;
        if (cycle < cycles(s)) all.add(current);
        return all;
    }
};

struct PhaseSum {
    double count = 0, x = 0, y = 0;
    void spike(double cycles_elapsed) { ++count, x += num::cos_turns(cycles_elapsed), y += num::sin_turns(cycles_elapsed); }
    void add(const PhaseSum& o) { count += o.count, x += o.x, y += o.y; }
};

/// Vector strength after Goldberg & Brown 1969 (J Neurophysiol 32:613): each spike is a unit vector at its phase of the stimulus cycle, and
/// the value is the length of their mean. A single spike always gives 1, so at least two are required.
struct VectorStrength : CycleMeasure<PhaseSum> {
    static constexpr MeasureInfo info{"vector_strength", "vector strength", "", 3,
                                      "phase locking of the spikes to the stimulus cycle: 1 all at one phase, 0 uniformly distributed"};
    double value(const TimeWindow& s) const {
        const auto all = complete(s);
        return all.count >= 2 ? std::sqrt(all.x * all.x + all.y * all.y) / all.count : no_value;
    }
};

struct SingleSpikeSum {
    double spikes = 0, singles = 0;
    void spike(double) { ++spikes, singles = spikes == 1; }
    void add(const SingleSpikeSum& o) { singles += o.singles; }
};

/// A response with one spike in each cycle is called "tuned" by Talbot et al. 1968 (J Neurophysiol 31:301) and "entrained one to one" by
/// others.
struct Entrainment : CycleMeasure<SingleSpikeSum> {
    static constexpr MeasureInfo info{"entrainment", "entrainment", "", 3,
                                      "fraction of the complete stimulus cycles with exactly one spike"};
    double value(const TimeWindow& s) const {
        return s.stimulus_frequency > 0 && cycles(s) >= 1 ? complete(s).singles / cycles(s) : no_value;
    }
};

}  // namespace corpuscle
