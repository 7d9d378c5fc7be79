#pragma once
// Versions of one receptor beside each other on every channel: how many spikes in each phase, and how far the trains are apart.

#include <cmath>
#include <nlohmann/json_fwd.hpp>

#include "study/respond.hpp"
#include "study/versions.hpp"

namespace corpuscle {

/// One version on one channel, held against the first of its receptor.
struct Comparison {
    struct Count {
        std::string phase;
        std::size_t spikes = 0, in_reference = 0;
        double excess() const;  ///< share of the reference's; NaN where that has none
    };
    std::string receptor, afferent, reference, channel;
    Count all;                                    ///< the phase's name is empty
    std::vector<Count> phases = {};               ///< as the stimulus says them, else empty
    std::size_t matched = 0;                      ///< spikes of both taken for each other: see victor_purpura
    double mean_shift = NAN, median_shift = NAN;  ///< s, of the matched: positive is later than the reference; NaN: none
    double victor_purpura = NAN;                  ///< NaN: too many spikes within reach of each other
    double van_rossum = 0;
};

/// Keeps the spikes of who has several versions, and of nobody else. Copies are not compared.
class Comparisons final : public Listener {
public:
    static constexpr double cost = 100;   ///< 1/s, of Victor and Purpura's distance; its moves are the matches, closer than 2 / cost
    static constexpr double tau = 10e-3;  ///< s, of van Rossum's

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    const std::vector<Comparison>& rows() const { return rows_; }
    nlohmann::ordered_json document() const;

private:
    std::vector<Versions> versions_;           // those of several
    std::vector<bool> kept_;                   // of each afferent
    std::vector<std::vector<double>> trains_;  // of each unit of the input at work, s from its start
    Clock since_start_;
    std::vector<Comparison> rows_;

    Comparison compared(const Input&, std::size_t channel, const Versions&, std::size_t member) const;
};

}  // namespace corpuscle
