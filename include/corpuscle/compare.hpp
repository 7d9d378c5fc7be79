#pragma once
// Compares spike trains, as `corpuscle compare` does.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "corpuscle/respond.hpp"
#include "corpuscle/spikes.hpp"

namespace corpuscle {

/// How trains are paired and compared.
struct ComparisonSettings {
    std::vector<std::string> pairs = {};  ///< "A-NAME=B-NAME": train A-NAME of a with B-NAME of b; empty: trains of equal name
    bool by_order = false;                ///< train k of a with train k of b
    double window = 5e-3;                 ///< s: spikes that are farther apart do not match
    double cost = 100;                    ///< 1/s, of moving a spike in the Victor-Purpura distance
    double tau = 10e-3;                   ///< s, time constant of the van Rossum distance
    /// Called with the completed fraction, 0 to 1. If it returns false, the comparison stops with InterruptedError.
    std::function<bool(double)> progress = {};
};

/// The differences of two trains, or of all pairs together. Times are in s; NaN if no spikes match.
struct TrainComparison {
    std::string a, b;  ///< names of the trains
    std::size_t spikes_a = 0, spikes_b = 0, matched = 0;
    std::size_t missing = 0, extra = 0;   ///< spikes of a without a match in b; spikes of b without a match in a
    double max_shift = 0, rms_shift = 0;  ///< of matched spikes, s
    double victor_purpura = 0, victor_purpura_per_spike = 0, van_rossum = 0;
};

struct Comparison {
    std::vector<TrainComparison> pairs;
    TrainComparison total;
    std::string text;      ///< the table that `corpuscle compare` prints
    std::string document;  ///< its JSON document
};

/// The trains of a response, one for each afferent.
CORPUSCLE_API std::vector<SpikeTrain> trains_of(const Response&);
/// Compares trains; `a` is the reference. Throws InputError.
CORPUSCLE_API Comparison compare(const std::vector<SpikeTrain>& a, const std::vector<SpikeTrain>& b, const ComparisonSettings& = {});
/// Compares two spike files in any format that read_spike_trains() reads. Throws InputError.
CORPUSCLE_API Comparison compare_files(const std::string& a, const std::string& b, const ComparisonSettings& = {});

}  // namespace corpuscle
