#pragma once
// Pairs the spike trains of two files, A and B, and measures how the trains of a pair differ.

#include <optional>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {

struct CompareOptions {
    std::vector<std::string> pairs = {};  ///< "A-NAME=B-NAME", as for --pair; empty: trains of equal name are paired
    bool by_order = false;                ///< true: train k of A is paired with train k of B
    double window = 5e-3;                 ///< s: spikes that are farther apart cannot match
    double cost = 100;                    ///< 1/s, of moving a spike in the Victor-Purpura distance
    double tau = 10e-3;                   ///< s, time constant of the van Rossum distance
};

/// A train of file A and its partner in file B. If one of them is missing (null), the other is compared with an empty train.
struct TrainPair {
    const NamedTrain *a, *b;
};

/// Differences of one pair of trains, or of all pairs together.
struct TrainDifference {
    std::string a = {}, b = {};              ///< names of the trains; "" for all pairs together
    std::size_t spikes_a = 0, spikes_b = 0;  ///< number of spikes
    std::size_t matched = 0;                 ///< number of spikes of A that match a spike of B
    double max_shift = 0;                    ///< s, largest |t_B - t_A| of matched spikes
    double sum_of_squares = 0;               ///< s^2, sum of (t_B - t_A)^2 over matched spikes
    double victor_purpura = 0;               ///< the sum for all pairs together
    double van_rossum_squared = 0;  ///< the sum for all pairs together: each afferent is a dimension of its own (Houghton & Sen 2008)

    std::size_t missing() const { return spikes_a - matched; }  ///< number of spikes of A without a match
    std::size_t extra() const { return spikes_b - matched; }    ///< number of spikes of B without a match
    double rms() const;                                         ///< s, rms of t_B - t_A over matched spikes; NaN if no spikes match
    double van_rossum() const;                                  ///< square root of van_rossum_squared
    double victor_purpura_per_spike() const;                    ///< victor_purpura / (spikes_a + spikes_b), 0 to 1; 0 without spikes
    /// Adds a pair to the differences of all pairs together.
    void add(const TrainDifference&);
};

/// Pairs the trains that CompareOptions::pairs names, or all trains in their order (by_order), or trains of equal name. If each file has a
/// single train, these are paired even if their names differ.
Result<std::vector<TrainPair>> pair_trains(const std::vector<NamedTrain>& a, const std::vector<NamedTrain>& b, const CompareOptions&);

/// Compares the two trains of a pair. Returns an error if there are too many pairs of close spikes.
Result<TrainDifference> compare_trains(const TrainPair&, const CompareOptions&);

}  // namespace corpuscle
