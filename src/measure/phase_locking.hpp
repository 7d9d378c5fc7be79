#pragma once
// Phase locking of spikes to a periodic stimulus. Only complete stimulus cycles count; the first one begins at the start of the time
// window.

#include "core/number/elementary.hpp"
#include "measure/measure_base.hpp"

namespace corpuscle {

/// Base of the measures of phase locking. Sum collects the spikes of cycles: spike(cycles_elapsed) adds a spike, add(other) adds the sum of
/// another cycle. The spikes of a cycle are added to `sum` only when a spike of a later cycle comes, because the last cycle of the window
/// may be incomplete and then does not count.
template <class Sum>
struct CycleMeasure : MeasureBase {
    double cycle = -1;  // index of the cycle of the latest spike, counted from the start of the window; -1: no spike yet
    Sum current{};      // over the spikes of this cycle
    Sum sum{};          // over the earlier cycles

    void spike(double t, const TimeWindow& window) {
        if (!(window.stimulus_frequency > 0)) return;
        const double cycles_elapsed = (t - window.from) * window.stimulus_frequency;  // since the start of the window
        if (std::floor(cycles_elapsed) != cycle) sum.add(current), current = {}, cycle = std::floor(cycles_elapsed);
        current.spike(cycles_elapsed);
    }
    /// The number of complete cycles in the window. Without the factor, rounding could make a complete last cycle incomplete.
    static double cycles(const TimeWindow& window) {
        return std::floor((window.to - window.from) * window.stimulus_frequency * (1 + 1e-12));
    }
    /// The sum over the complete cycles.
    Sum complete(const TimeWindow& window) const {
        Sum all = sum;
        if (cycle < cycles(window)) all.add(current);
        return all;
    }
};

/// The number of spikes, and the sum (x, y) of unit vectors at their phases of the stimulus cycle.
struct PhaseSum {
    double count = 0, x = 0, y = 0;
    void spike(double cycles_elapsed) { ++count, x += num::cos_turns(cycles_elapsed), y += num::sin_turns(cycles_elapsed); }
    void add(const PhaseSum& o) { count += o.count, x += o.x, y += o.y; }
};

/// Vector strength after Goldberg & Brown 1969 (J Neurophysiol 32:613): each spike is a unit vector at its phase of the stimulus cycle, and
/// the value is the length of the mean of these vectors. For a single spike it would always be 1, so at least two spikes are required.
struct VectorStrength : CycleMeasure<PhaseSum> {
    static constexpr MeasureInfo info{"vector_strength", "vector strength", "", 3,
                                      "phase locking of the spikes to the stimulus cycle: 1 all at one phase, 0 uniformly distributed"};
    double value(const TimeWindow& window) const {
        const auto all = complete(window);
        return all.count >= 2 ? std::sqrt(all.x * all.x + all.y * all.y) / all.count : no_value;
    }
};

/// Counts cycles with exactly one spike.
struct SingleSpikeSum {
    double spikes = 0;   // spikes of one cycle; not used in a sum over cycles
    double singles = 0;  // cycles with exactly one spike
    void spike(double) { ++spikes, singles = spikes == 1; }
    void add(const SingleSpikeSum& o) { singles += o.singles; }
};

/// The fraction of the complete cycles with exactly one spike. Talbot et al. 1968 (J Neurophysiol 31:301) call a response with one spike in
/// each cycle "tuned", others "entrained one to one".
struct Entrainment : CycleMeasure<SingleSpikeSum> {
    static constexpr MeasureInfo info{"entrainment", "entrainment", "", 3,
                                      "fraction of the complete stimulus cycles with exactly one spike"};
    double value(const TimeWindow& window) const {
        return window.stimulus_frequency > 0 && cycles(window) >= 1 ? complete(window).singles / cycles(window) : no_value;
    }
};

}  // namespace corpuscle
