#pragma once
// Detectors of recording faults. They run while a channel is read, with bounded memory, and do not depend on the block size. In a
// long recording the detectors of outliers and hum examine every chunk at first, later only one chunk in two, four and so on. A chunk
// is 4096 samples for outliers and one second for hum.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/log_histogram.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

/// Detects isolated outliers: samples that are far above or far below both neighbours and the median of seven samples. Causes are
/// transmission errors (two in a row are not detected) or taps too short for the sample rate.
class OutlierDetector {
    std::vector<double> chunk_;     // the last samples of the current chunk, at most six
    LogHistogram deviations_;       // distances from the median of seven
    LogHistogram isolations_;       // the smallest of the distances from both neighbours and the median
    double min_isolation_ = 0;      // the smallest distance above 0: the resolution of the sensor
    std::vector<double> retained_;  // samples at increasing intervals, for the quartiles
    std::int64_t seen_ = 0, examined_ = 0, stride_ = 1, next_retained_ = 0;

    void examine(std::span<const double>);
    void retain(std::span<const double>);
    double interquartile_range() const;

public:
    void add(std::span<const double>);
    std::int64_t examined() const { return examined_; }
    /// The number of outliers among the examined samples. The isolation of an outlier exceeds 8 times the median deviation, a tenth of
    /// the interquartile range, and 4 times the resolution.
    std::int64_t count() const;
};

/// Detects a saturated sensor or converter: it reaches its highest value repeatedly and stays there.
class SaturationDetector {
    double highest_ = -1e308, lowest_ = 1e308;
    std::int64_t run_ = 0, runs_ = 0;         // samples in the current run at highest_, and number of runs of three samples or more
    std::int64_t at_highest_ = 0, seen_ = 0;  // samples at highest_, and all samples

public:
    void add(std::span<const double>);
    double highest() const { return highest_; }
    bool varies() const { return lowest_ < highest_; }
    /// The fraction of the samples at the highest value.
    double fraction() const { return seen_ > 0 ? static_cast<double>(at_highest_) / static_cast<double>(seen_) : 0; }
    bool is_likely() const { return runs_ >= 3; }  ///< the highest value was held at least three times for three samples or more
};

/// Detects channels that are the sum of neighbouring channels, such as totals in a table. Uses the first rows.
class SumDetector {
    static constexpr std::size_t max_channels = 64, rows = 64;
    std::vector<std::vector<double>> first_;
    bool is_sum(std::size_t c, std::size_t from, std::size_t to) const;

public:
    struct Sum {  // `channel` is the sum of the channels `from` to `to`
        std::size_t channel, from, to;
    };
    /// Adds a block with one vector for each channel. Only the first `channels` vectors are channels.
    void add(const std::vector<std::vector<double>>& block, std::size_t channels = max_channels + 1);
    std::vector<Sum> find_sums() const;
};

/// Tables that all channels of one clock share to detect hum: windowed phasors, one second long, at six frequencies (50 and 60 Hz, and
/// 6 Hz below and above each of them).
struct HumTable {
    static constexpr std::size_t line_count = 6;
    struct Phasors {
        double re[line_count], im[line_count];
    };
    double mains[2] = {50, 60};
    std::int64_t decimation = 1;  ///< this number of samples is averaged, so that a second has fewer than 2000 samples
    std::vector<Phasors> phasors_of_second;  ///< for each decimated sample of a second; empty if the sample rate is below 2 Hz
    explicit HumTable(const Clock&);
    /// True if the sample rate suffices for mains[mains_index].
    bool covers(std::size_t mains_index) const { return static_cast<double>(phasors_of_second.size()) > 2.2 * mains[mains_index]; }
};

/// Detects mains hum: the fraction of the variance within a second that is at 50 or 60 Hz, if it exceeds the adjacent frequencies.
class HumDetector {
    const HumTable& table_;
    // Sums over the examined seconds: the power at each frequency of the table, and the variance.
    double power_[HumTable::line_count] = {}, variance_ = 0;
    // The current second. Its first sample is subtracted from all its samples.
    std::int64_t second_ = 0;  // its number
    std::size_t at_ = 0;       // number of its decimated samples so far
    HumTable::Phasors sum_{};
    double first_ = 0, total_ = 0, squares_ = 0;
    // The current group of samples, which become one decimated sample.
    double decimated_ = 0;  // their sum
    std::int64_t in_group_ = 0;

    void add_decimated(double);
    void end_second();
    bool is_significant(std::size_t mains_index) const;

public:
    explicit HumDetector(const HumTable& table) : table_(table) {}
    void add(std::span<const double>);
    /// The mains frequency and its fraction of the variance. {0, 0} if there is no hum.
    struct Hum {
        double frequency = 0, fraction = 0;
    };
    Hum result() const;
};

}  // namespace corpuscle
