#pragma once
// Phase locking of spikes to a periodic stimulus, over the complete cycles of a phase, counted from its start.

#include <cmath>

#include "measure/stretch.hpp"
#include "signal/elementary.hpp"

namespace corpuscle {

/// The spikes of a cycle are added only when the next one begins. The last cycle may be incomplete, and is then not counted.
template <class Sum>
struct ByCycle : Deaf {
    double cycle = -1;  // index of the current cycle
    Sum held{}, sum{};

    void spike(double t, const Stretch& s) {
        if (!(s.cycle > 0)) return;
        const double cycles_elapsed = (t - s.from) * s.cycle;
        if (std::floor(cycles_elapsed) != cycle) sum.add(held), held = {}, cycle = std::floor(cycles_elapsed);
        held.spike(cycles_elapsed);
    }
    static double cycles(const Stretch& s) { return std::floor((s.to - s.from) * s.cycle * (1 + 1e-12)); }
    Sum whole(const Stretch& s) const {
        Sum all = sum;
        if (cycle < cycles(s)) all.add(held);
        return all;
    }
};

struct PhaseSum {
    double count = 0, x = 0, y = 0;
    void spike(double cycles_elapsed) { ++count, x += num::cos_turns(cycles_elapsed), y += num::sin_turns(cycles_elapsed); }
    void add(const PhaseSum& o) { count += o.count, x += o.x, y += o.y; }
};

/// Goldberg & Brown 1969 (J Neurophysiol 32:613): the length of the mean of the spikes' phases as unit vectors. A single spike always gives
/// 1, so at least two are required.
struct VectorStrength : ByCycle<PhaseSum> {
    static constexpr Measure row{"vector_strength", "vector strength", "", 3,
                                 "phase locking of the spikes to the stimulus cycle: 1 all at one phase, 0 uniformly distributed"};
    double value(const Stretch& s) const {
        const auto all = whole(s);
        return all.count >= 2 ? std::sqrt(all.x * all.x + all.y * all.y) / all.count : no_value;
    }
};

struct SingleSum {
    double spikes = 0, singles = 0;
    void spike(double) { ++spikes, singles = spikes == 1; }
    void add(const SingleSum& o) { singles += o.singles; }
};

/// One spike per cycle is called tuned by Talbot et al. 1968 (J Neurophysiol 31:301), and entrained one to one by others.
struct Entrainment : ByCycle<SingleSum> {
    static constexpr Measure row{"entrainment", "entrainment", "", 3, "fraction of the complete stimulus cycles with exactly one spike"};
    double value(const Stretch& s) const { return s.cycle > 0 && cycles(s) >= 1 ? whole(s).singles / cycles(s) : no_value; }
};

}  // namespace corpuscle
