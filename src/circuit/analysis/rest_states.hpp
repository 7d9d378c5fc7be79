#pragma once
// All the states in which a circuit may rest, as far as a search finds them, and the one that it comes to when it is switched on.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

struct RestState {
    std::vector<double> x;
    bool stable = true;     ///< a small disturbance dies out (growth_at)
    bool usual = false;     ///< the one that TestBench::rest() finds
    bool power_on = false;  ///< the one that it comes to from 0 V when its sources rise
};

/// Where it rests: from where .op finds it; with each node in turn pushed to either end of the supply and let go; along the way on
/// which it is switched on; and half way between any two that are stable, where there is one that is not. States count as two when some
/// node differs by more than a millivolt. That these are all is not proven. First the usual one, then stable ones, then the others, each in
/// the order of their voltages. Of a drawn bench: those of its chip.
///
/// Switched on: a transient from 0 V everywhere, without .ic, in which every source of V and I rises on a straight line within `rise` (s)
/// to what it is in .op; its end, when it stands still, is a state. No state has the mark where it does not come to stand.
Result<std::vector<RestState>> rest_states(TestBench&, double rise = 1e-3);

/// The voltages in which two states differ by more than a millivolt, the largest first.
std::vector<std::size_t> differing(const TestBench&, const RestState&, const RestState&);

/// The states in words: how many, which one has which mark, and where they differ.
std::string told(const TestBench&, const std::vector<RestState>&);

}  // namespace corpuscle::circuit
