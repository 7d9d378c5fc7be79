#pragma once
// Compares the versions of one receptor on every channel: spikes in each phase, and distance between the trains.

#include <cmath>
#include <nlohmann/json_fwd.hpp>

#include "study/respond.hpp"
#include "study/versions.hpp"

namespace corpuscle {

/// One version on one channel, compared with the reference version of its receptor.
struct Comparison {
    struct Count {
        std::string phase;
        std::size_t spikes = 0, in_reference = 0;
        double excess() const;  ///< fraction of the reference's count; NaN if that is zero
    };
    std::string receptor, afferent, reference, channel;
    Count all;                                    ///< over the whole input; its phase name is empty
    std::vector<Count> phases = {};               ///< phases of the stimulus; empty if it has none
    std::size_t matched = 0;                      ///< spikes matched with one of the reference, see victor_purpura
    double mean_shift = NAN, median_shift = NAN;  ///< s, of matched spikes; positive: later than the reference; NaN: none matched
    double victor_purpura = NAN;                  ///< NaN: too many spikes close to each other to compute it
    double van_rossum = 0;
};

/// Keeps the spikes of afferents that have several versions. Copies are not compared.
class Comparisons final : public Listener {
public:
    static constexpr double cost = 100;   ///< 1/s, for the Victor-Purpura distance; spikes that it moves are matches, closer than 2 / cost
    static constexpr double tau = 10e-3;  ///< s, for the van Rossum distance

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    const std::vector<Comparison>& rows() const { return rows_; }
    nlohmann::ordered_json document() const;

private:
    std::vector<Versions> versions_;           // groups with several versions
    std::vector<bool> kept_;                   // for each afferent plan
    std::vector<std::vector<double>> trains_;  // of each afferent of the current input, s from its start
    Clock since_start_;
    std::vector<Comparison> rows_;

    Comparison compared(const Input&, std::size_t channel, const Versions&, std::size_t member) const;
};

}  // namespace corpuscle
