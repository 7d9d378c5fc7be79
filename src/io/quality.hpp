#pragma once
// How well a channel was recorded, found while it is read, in little memory and whatever the blocks. Long recordings are looked at
// second by second for the first minutes, then at seconds further and further apart.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/log_histogram.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

/// Readings that stand alone: on one side of both neighbours and of the median of the seven about them, and far from all three. Torn
/// readings do so (two in a row are not seen), or taps too short for the rate.
class StrayCheck {
    std::vector<double> chunk_;  // the last readings of the chunk at work, at most six
    LogHistogram off_;           // distances from the median of seven
    LogHistogram alone_;         // the least of the three distances
    double least_alone_ = 0;     // the smallest but 0: what the sensor can tell apart
    std::vector<double> kept_;   // readings ever further apart, for the quartiles
    std::int64_t seen_ = 0, examined_ = 0, stride_ = 1, next_kept_ = 0;

    void examine(std::span<const double>);
    void keep(std::span<const double>);
    double quartiles_apart() const;

public:
    void add(std::span<const double>);
    std::int64_t examined() const { return examined_; }
    /// Of those examined: by more than eight times the usual distance, a tenth of the quartiles' distance, and four of the least steps.
    std::int64_t count() const;
};

/// A saturated sensor or converter comes back to its highest value and stays there.
class SaturationCheck {
    double highest_ = -1e308, lowest_ = 1e308;
    std::int64_t run_ = 0, runs_ = 0, at_highest_ = 0, seen_ = 0;

public:
    void add(std::span<const double>);
    double highest() const { return highest_; }
    bool varies() const { return lowest_ < highest_; }
    double share() const { return seen_ > 0 ? static_cast<double>(at_highest_) / static_cast<double>(seen_) : 0; }
    bool likely() const { return runs_ >= 3; }  ///< three times or more held for three readings or more
};

/// Channels that are the sum of neighbouring ones, as totals in a table are: found in its first rows.
class SumCheck {
    static constexpr std::size_t most_channels = 64, rows = 64;
    std::vector<std::vector<double>> first_;
    bool is_sum(std::size_t c, std::size_t from, std::size_t to) const;

public:
    struct Sum {
        std::size_t channel, from, to;
    };
    /// A block of rows, one vector a channel; `channels`: how many of the vectors are.
    void add(const std::vector<std::vector<double>>& block, std::size_t channels = most_channels + 1);
    std::vector<Sum> found() const;
};

/// What the channels of one clock share in looking for hum: windowed sines below, at and above 50 and 60 Hz, a second long.
struct HumTable {
    static constexpr std::size_t lines = 6;
    struct Turn {
        double re[lines], im[lines];
    };
    double mains[2] = {50, 60};
    std::int64_t fold = 1;  ///< samples taken as one, so that a second has some thousand at the most
    std::vector<Turn> second;
    explicit HumTable(const Clock&);
    bool sees(std::size_t which) const { return static_cast<double>(second.size()) > 2.2 * mains[which]; }
};

/// The share of a line at 50 or 60 Hz, if it stands out of its surroundings, in what varies within a second.
class HumCheck {
    const HumTable& table_;
    HumTable::Turn sum_{};
    double power_[HumTable::lines] = {};
    double folded_ = 0, first_ = 0, total_ = 0, squares_ = 0, variance_ = 0;
    std::int64_t in_fold_ = 0, second_ = 0;
    std::size_t at_ = 0;

    void add_folded(double);
    void end_second();
    bool stands_out(std::size_t which) const;

public:
    explicit HumCheck(const HumTable& table) : table_(table) {}
    void add(std::span<const double>);
    /// Which of the two mains there is, and its share; {0, 0}: none.
    struct Hum {
        double frequency = 0, share = 0;
    };
    Hum found() const;
};

}  // namespace corpuscle
