#pragma once
// Distances between two spike trains. Trains are in order of time.

#include <span>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// Spike number `a` of one train is matched with spike number `b` of the other. Numbers count from 0.
struct SpikePair {
    std::size_t a = 0, b = 0;
    friend bool operator==(const SpikePair&, const SpikePair&) = default;
};

struct Alignment {
    double distance = 0;
    std::vector<SpikePair> moved;  ///< in order; every other spike is removed or added
};

/// Victor & Purpura 1996 (J Neurophysiol 76:1310), D^spike: the minimum cost of transforming one train into the other. Removing or adding a
/// spike costs 1; moving one by dt costs q |dt| (q in 1/s). The result is exact. Moving a spike by more than 2/q costs more than
/// removing and adding one, so the computing time is proportional to the number of pairs closer than 2/q. More than max_candidates() pairs
/// are an error.
Result<double> victor_purpura(std::span<const double> a, std::span<const double> b, double q);
/// The same, with the spikes that are moved: pairs closer than 2/q whose move is part of the minimum cost. More than a quarter of
/// max_candidates() pairs are an error.
Result<Alignment> align_trains(std::span<const double> a, std::span<const double> b, double q);
constexpr std::size_t max_candidates() { return std::size_t{1} << 32; }

/// The square of van Rossum's distance (2001, Neural Comput 13:751) with time constant tau (s), scaled so that one extra isolated spike
/// counts 1. It is (2/tau) int (f - g)^2 dt, where each spike is a step to 1 that decays with tau. Van Rossum's own square, 1/tau times the
/// integral, is half of it. The result is exact, and computed in one pass (Houghton & Kreuz 2012, Network 23:48).
double van_rossum_squared(std::span<const double> a, std::span<const double> b, double tau);

}  // namespace corpuscle
