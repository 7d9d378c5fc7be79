#pragma once
// Two files' trains, paired by name, and how they differ.

#include <optional>

#include "io/spikes.hpp"

namespace corpuscle {

struct CompareOptions {
    std::vector<std::string> pairs = {};  ///< "A-NAME=B-NAME"; empty: those of one name
    bool by_order = false;
    double window = 5e-3;  ///< s: spikes closer than this may match
    double cost = 100;     ///< 1/s, of the Victor-Purpura distance
    double tau = 10e-3;    ///< s, of the van Rossum distance
};

/// A train of A and what it is compared with. A train without a partner is compared with silence.
struct PairedTrains {
    std::string a, b;  ///< names; empty: the file has no such train
    const std::vector<double>*in_a = nullptr, *in_b = nullptr;
};

/// How one pair, or all of them together, differ.
struct Difference {
    std::string a = {}, b = {};
    std::size_t in_a = 0, in_b = 0, matched = 0;
    double largest = 0;  ///< s, of |b - a| over the matched
    double squares = 0;  ///< s^2, summed over the matched
    double victor_purpura = 0;
    double van_rossum_squared = 0;  ///< of all pairs together: the sum, each unit a line of its own (Houghton & Sen 2008)

    std::size_t missing() const { return in_a - matched; }
    std::size_t extra() const { return in_b - matched; }
    double rms() const;  ///< s; NaN if nothing matched
    double van_rossum() const;
    double per_spike() const;  ///< victor_purpura over all spikes, 0 to 1; 0 if there are none
    void add(const Difference&);
};

/// Who is compared with whom: those of one name (or the only two there are), those that --pair names, or all in their order.
Result<std::vector<PairedTrains>> pair_trains(const std::vector<NamedTrain>& a, const std::vector<NamedTrain>& b, const CompareOptions&);

Result<Difference> compare(const PairedTrains&, const CompareOptions&);

}  // namespace corpuscle
