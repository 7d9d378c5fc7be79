#pragma once
// How far two spike trains are from each other. Trains are in order of time.

#include <span>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// Spike number a of one train and number b of the other are taken for each other.
struct Match {
    std::size_t a = 0, b = 0;
    friend bool operator==(const Match&, const Match&) = default;
};

struct Alignment {
    double distance = 0;
    std::vector<Match> moved;  ///< in order; every other spike is removed or added
};

/// Victor & Purpura 1996 (J Neurophysiol 76:1310), D^spike: the least cost that makes one train of the other, when to remove or to
/// add a spike costs 1 and to move one by dt costs q |dt| (q per second). Exact; only spikes closer than 2/q can be worth moving, so
/// work grows with the spikes times those within 2/q of them. Refuses more than most_candidates() such pairs.
Result<double> victor_purpura(std::span<const double> a, std::span<const double> b, double q);
/// The same, with the spikes that are moved: those at a distance below 2/q whose move is part of the least cost.
Result<Alignment> align(std::span<const double> a, std::span<const double> b, double q);
constexpr std::size_t most_candidates() { return std::size_t{1} << 32; }

/// The square of van Rossum's distance (2001, Neural Comput 13:751) with time constant tau (s), scaled so that one extra spike, far
/// from others, counts 1: (2/tau) int (f - g)^2 dt with each spike a step to 1 that decays with tau. Van Rossum's own square, 1/tau
/// times the integral, is half of it. Exact, in one pass (Houghton & Kreuz 2012, Network 23:48).
double van_rossum_squared(std::span<const double> a, std::span<const double> b, double tau);

}  // namespace corpuscle
