#pragma once
// Measures the noise of a sensor while its channel is read, from the third differences of the samples, in which slow forces cancel.

#include <span>

#include "io/quality/log_histogram.hpp"

namespace corpuscle {

/// Divides a channel into chunks of 16 samples. A chunk is noise if the mean of its third differences is at least 2.3 times that of its
/// first ones. The ratio is sqrt(10) for white noise, below 1 for forces that change slowly, and (2 sin(pi f / rate))^2 for a vibration.
/// The result does not depend on the size of the blocks that are added.
class NoiseDetector {
    static constexpr std::int64_t chunk = 16;
    LogHistogram deviations_;              // standard deviations of the chunks that are noise, N
    std::int64_t chunks_ = 0;              // all chunks so far
    double x_1_ = 0, d_1_ = 0, dd_1_ = 0;  // the last sample, and its first and second difference, N
    double first_ = 0, third_ = 0;         // sums of the absolute differences of the chunk, N
    std::int64_t seen_ = 0;                // samples so far

    void end_chunk();

public:
    void add(std::span<const double>);
    /// The standard deviation of the noise, N: the median of the noisy chunks. 0 if fewer than a tenth of all chunks are noise.
    double deviation() const;
};

}  // namespace corpuscle
