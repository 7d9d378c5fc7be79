#pragma once
// Detectors of recording faults. They run while a channel is read, with bounded memory, and their results do not depend on the size of the
// blocks that are read. The detectors of outliers and hum divide a recording into chunks, of 4096 samples for outliers and one second for
// hum. They examine every chunk at first; later in a long recording they examine only one chunk in two, in four and so on. add() of a
// detector adds the next samples of its channel.

#include <span>
#include <vector>

#include "core/clock.hpp"
#include "io/quality/log_histogram.hpp"

namespace corpuscle {

/// Detects isolated outliers: samples that are far above or far below both neighbours and the median of seven samples. Causes are
/// transmission errors (two in a row are not detected) or taps too short for the sample rate.
class OutlierDetector {
    std::vector<double> chunk_;     // the latest samples of the current chunk, at most six
    LogHistogram deviations_;       // distances of samples from the median of the seven samples around them
    LogHistogram isolations_;       // for samples above or below both neighbours: the smallest of the distances from neighbours and median
    double min_isolation_ = 0;      // the smallest isolation so far, an estimate of the sensor's resolution; 0: none so far
    std::vector<double> retained_;  // evenly spaced samples of the complete recording so far, for the quartiles
    std::int64_t seen_ = 0;         // number of samples so far
    std::int64_t examined_ = 0;     // number of them that were examined
    std::int64_t stride_ = 1, next_retained_ = 0;  // distance of retained samples, and index of the next one

    void examine(std::span<const double>);
    void retain(std::span<const double>);
    double interquartile_range() const;

public:
    void add(std::span<const double>);
    std::int64_t examined() const { return examined_; }  ///< number of samples
    /// The number of outliers among the examined samples. A sample is an outlier if its isolation exceeds 8 times the median deviation, a
    /// tenth of the interquartile range of the recording, and 4 times the resolution.
    std::int64_t count() const;
};

/// Detects a saturated sensor or converter: the force reaches its highest value repeatedly and stays there.
class SaturationDetector {
    double highest_ = -1e308, lowest_ = 1e308;
    std::int64_t run_ = 0, runs_ = 0;         // consecutive samples at highest_ up to now, and number of such runs of three or more samples
    std::int64_t at_highest_ = 0, seen_ = 0;  // samples at highest_, and all samples

public:
    void add(std::span<const double>);
    double highest() const { return highest_; }
    bool varies() const { return lowest_ < highest_; }  ///< false if all samples are equal
    /// The fraction of the samples at the highest value.
    double fraction() const { return seen_ > 0 ? static_cast<double>(at_highest_) / static_cast<double>(seen_) : 0; }
    bool is_likely() const { return runs_ >= 3; }  ///< the highest value was held at least three times for three samples or more
};

/// Detects channels that are the sum of neighbouring channels, such as totals in a table. Examines the first 64 rows of a recording of at
/// most 64 channels.
class SumDetector {
    static constexpr std::size_t max_channels = 64, rows = 64;
    std::vector<std::vector<double>> first_;  // for each channel, its samples of these rows
    bool is_sum(std::size_t c, std::size_t from, std::size_t to) const;

public:
    struct Sum {  // `channel` is the sum of the channels `from` to `to`
        std::size_t channel, from, to;
    };
    /// Adds a block with one vector of samples for each column, of which the first `channels` are channels (by default all).
    void add(const std::vector<std::vector<double>>& block, std::size_t channels = max_channels + 1);
    std::vector<Sum> find_sums() const;
};

/// A table that all channels of one clock share to detect hum: windowed phasors over one second, at six frequencies. These are 44, 50, 56,
/// 54, 60 and 66 Hz: for each mains frequency itself, and 6 Hz below and above it.
struct HumTable {
    static constexpr std::size_t line_count = 6;  ///< number of frequencies
    struct Phasors {
        double re[line_count], im[line_count];  ///< for each frequency
    };
    double mains[2] = {50, 60};   ///< Hz
    std::int64_t decimation = 1;  ///< number of samples that are averaged to one decimated sample; a second has fewer than 2000 of these
    std::vector<Phasors> phasors_of_second;  ///< for each decimated sample of a second; empty if the sample rate is below 2 Hz
    explicit HumTable(const Clock&);
    /// True if the rate of the decimated samples is high enough to detect mains[mains_index].
    bool covers(std::size_t mains_index) const { return static_cast<double>(phasors_of_second.size()) > 2.2 * mains[mains_index]; }
};

/// Detects mains hum, and the fraction that it has of the variance within a second. The power at 50 or 60 Hz counts as hum only if it
/// exceeds four times that at the frequencies 6 Hz away.
class HumDetector {
    const HumTable& table_;
    // Sums over the examined seconds: the power at each frequency of the table (N^2), and the variance (N^2).
    double power_[HumTable::line_count] = {}, variance_ = 0;
    // The current second. Its first sample is subtracted from all its samples.
    std::int64_t second_ = 0;         // its number, counted from 0
    std::size_t at_ = 0;              // number of its decimated samples so far
    HumTable::Phasors sum_{};         // of its samples times the phasors
    double first_ = 0;                // its first decimated sample
    double total_ = 0, squares_ = 0;  // sums of its samples and of their squares
    // The current group of samples, which become one decimated sample.
    double decimated_ = 0;       // sum of its samples so far
    std::int64_t in_group_ = 0;  // number of its samples so far

    void add_decimated(double);
    void end_second();
    bool is_significant(std::size_t mains_index) const;

public:
    explicit HumDetector(const HumTable& table) : table_(table) {}
    void add(std::span<const double>);
    /// The mains frequency in Hz, and the fraction that the hum has of the variance. {0, 0} if there is no hum.
    struct Hum {
        double frequency = 0, fraction = 0;
    };
    /// The hum in all samples so far.
    Hum result() const;
};

}  // namespace corpuscle
