#pragma once
// Compares the implementations of one afferent type on every channel: spikes in each phase, and distance between the trains.

#include <cmath>
#include <nlohmann/json_fwd.hpp>

#include "study/afferent_run.hpp"
#include "study/implementation_group.hpp"

namespace corpuscle {

/// One implementation on one channel, compared with the reference of its afferent type.
struct ImplementationComparison {
    struct PhaseCount {
        std::string phase;
        std::size_t spikes = 0, reference_spikes = 0;
        double excess() const;  ///< fraction of the reference's count; NaN if that is zero
    };
    std::string afferent_type, afferent, reference, channel;
    PhaseCount total;                             ///< over the whole input; its phase name is empty
    std::vector<PhaseCount> phases = {};          ///< phases of the stimulus; empty if it has none
    std::size_t matched = 0;                      ///< spikes matched with one of the reference, see victor_purpura
    double mean_shift = NAN, median_shift = NAN;  ///< s, of matched spikes; positive if later than the reference, NaN if none matched
    double victor_purpura = NAN;                  ///< NaN: too many spikes close to each other to compute it
    double van_rossum = 0;
};

/// Keeps the spikes of afferent types that have several implementations. Copies are not compared.
class ImplementationComparisons final : public ResponseSink {
public:
    static constexpr double cost = 100;   ///< 1/s, for the Victor-Purpura distance; spikes that it moves are matches, closer than 2 / cost
    static constexpr double tau = 10e-3;  ///< s, for the van Rossum distance

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    const std::vector<ImplementationComparison>& rows() const { return rows_; }
    nlohmann::ordered_json document() const;

private:
    std::vector<ImplementationGroup> groups_;  // with several implementations
    std::vector<bool> is_kept_;                // for each afferent plan
    std::vector<std::vector<double>> trains_;  // of each afferent of the current input, s from its start
    Clock since_start_;
    std::vector<ImplementationComparison> rows_;

    ImplementationComparison compare_implementation(const Input&, std::size_t channel, const ImplementationGroup&,
                                                    std::size_t member) const;
};

}  // namespace corpuscle
