#pragma once
// How spikes keep to the cycles of a stimulus that repeats itself, over the whole cycles of a phase, counted from its start.

#include <cmath>

#include "measure/stretch.hpp"
#include "signal/elementary.hpp"

namespace corpuscle {

/// The spikes of one cycle are held back until the next begins: the last one may not be whole, and then they do not count.
template <class Sum>
struct ByCycle : Deaf {
    double cycle = -1;  // whose spikes are held back
    Sum held{}, sum{};

    void spike(double t, const Stretch& s) {
        if (!(s.cycle > 0)) return;
        const double turns = (t - s.from) * s.cycle;
        if (std::floor(turns) != cycle) sum.add(held), held = {}, cycle = std::floor(turns);
        held.spike(turns);
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
    void spike(double turns) { ++count, x += num::cos_turns(turns), y += num::sin_turns(turns); }
    void add(const PhaseSum& o) { count += o.count, x += o.x, y += o.y; }
};

/// Goldberg & Brown 1969 (J Neurophysiol 32:613): the length of the mean of the spikes' phases as unit vectors. One spike alone
/// always gives 1, so two are needed.
struct VectorStrength : ByCycle<PhaseSum> {
    static constexpr Measure row{"vector_strength", "vector strength", "", 3,
                                 "of the spikes' places in the stimulus's cycle: 1 all at one place, 0 evenly spread"};
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

/// One spike a cycle is what Talbot et al. 1968 (J Neurophysiol 31:301) call tuned, and others entrained one to one.
struct Entrainment : ByCycle<SingleSum> {
    static constexpr Measure row{"entrainment", "entrainment", "", 3, "share of the stimulus's whole cycles that have exactly one spike"};
    double value(const Stretch& s) const { return s.cycle > 0 && cycles(s) >= 1 ? whole(s).singles / cycles(s) : no_value; }
};

}  // namespace corpuscle
