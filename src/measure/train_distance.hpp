#pragma once
// Distances between two spike trains. A train is a list of spike times in s, in order of time.

#include <span>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A spike of train a and the spike of train b to which it is moved.
struct SpikePair {
    std::size_t a = 0, b = 0;  ///< indices of the spikes in their trains, counted from 0
    friend bool operator==(const SpikePair&, const SpikePair&) = default;
};

/// The cheapest way to transform train a into train b.
struct Alignment {
    double distance = 0;           ///< its cost, see victor_purpura()
    std::vector<SpikePair> moved;  ///< in order of time, including moves by 0 s; every other spike of a is removed, of b added
};

/// Victor & Purpura 1996 (J Neurophysiol 76:1310), D^spike: the minimum cost of transforming train a into train b. Removing or adding a
/// spike costs 1; moving one by dt costs q |dt| (q in 1/s). The result is exact. Moving a spike by more than 2/q costs more than removing
/// it and adding another one, so only pairs (a spike of a, a spike of b) that are at most 2/q apart are examined. The computing time is
/// proportional to their number, and more than max_candidates() of them are an error.
Result<double> victor_purpura(std::span<const double> a, std::span<const double> b, double q);
/// Like victor_purpura(), but also returns the spikes that are moved. More than a quarter of max_candidates() pairs are an error.
Result<Alignment> align_trains(std::span<const double> a, std::span<const double> b, double q);
/// The largest number of pairs that victor_purpura() examines.
constexpr std::uint64_t max_candidates() { return std::uint64_t{1} << 32; }

/// The square of van Rossum's distance (2001, Neural Comput 13:751) with time constant tau (s), scaled so that one extra isolated spike
/// counts 1. It is (2/tau) times the integral of (f - g)^2, where f(t) and g(t) are the sums of e^(-(t - t_k)/tau) over the spikes t_k <= t
/// of a and of b. The square in the publication, 1/tau times the integral, is half of it. The result is exact, and computed in one pass
/// (Houghton & Kreuz 2012, Network 23:48).
double van_rossum_squared(std::span<const double> a, std::span<const double> b, double tau);

}  // namespace corpuscle
