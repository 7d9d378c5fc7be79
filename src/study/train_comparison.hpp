#pragma once
// Pairs the trains of two files by name and measures how they differ.

#include <optional>

#include "io/spike_files.hpp"

namespace corpuscle {

struct CompareOptions {
    std::vector<std::string> pairs = {};  ///< "A-NAME=B-NAME"; empty: trains of equal name
    bool by_order = false;
    double window = 5e-3;  ///< s: largest distance of spikes that may match
    double cost = 100;     ///< 1/s, for the Victor-Purpura distance
    double tau = 10e-3;    ///< s, for the van Rossum distance
};

/// A train of file A and its partner in file B. A train without a partner is compared with an empty train.
struct TrainPair {
    std::string a, b;  ///< names; empty if the file has no such train
    const std::vector<double>*train_a = nullptr, *train_b = nullptr;
};

/// Difference of one pair, or of all pairs together.
struct TrainDifference {
    std::string a = {}, b = {};
    std::size_t spikes_a = 0, spikes_b = 0, matched = 0;
    double max_shift = 0;       ///< s, of |b - a| over matched spikes
    double sum_of_squares = 0;  ///< s^2, sum over matched spikes
    double victor_purpura = 0;
    double van_rossum_squared = 0;  ///< of all pairs together: the sum, with each afferent as a separate dimension (Houghton & Sen 2008)

    std::size_t missing() const { return spikes_a - matched; }
    std::size_t extra() const { return spikes_b - matched; }
    double rms() const;  ///< s; NaN if no spike matched
    double van_rossum() const;
    double victor_purpura_per_spike() const;  ///< victor_purpura over all spikes, 0 to 1; 0 without spikes
    void add(const TrainDifference&);
};

/// Pairs trains of equal name (or the only two), those named by --pair, or all by their order.
Result<std::vector<TrainPair>> pair_trains(const std::vector<NamedTrain>& a, const std::vector<NamedTrain>& b, const CompareOptions&);

Result<TrainDifference> compare_trains(const TrainPair&, const CompareOptions&);

}  // namespace corpuscle
