#pragma once
// A signal of any length in bounded memory. Up to `max_points` samples are kept as they are; a longer signal is kept as the minimum and
// maximum of each bucket of samples. The bucket size doubles as the signal grows.

#include <cstdint>
#include <string>
#include <vector>

namespace corpuscle {

class Envelope {
    std::vector<float> values_;  // bucket 1: samples; else min, max, min, max ...
    std::int64_t bucket_ = 1, last_count_ = 0;  // samples per bucket; samples in the last bucket
    std::size_t max_points_;

    void double_bucket();

public:
    explicit Envelope(std::size_t max_points = std::size_t{1} << 20) : max_points_(max_points) {}
    void add(double value);
    /// Samples per bucket.
    std::int64_t bucket() const { return bucket_; }
    /// The number of samples, or of pairs of minimum and maximum.
    std::size_t count() const { return bucket_ == 1 ? values_.size() : values_.size() / 2; }
    const std::vector<float>& values() const { return values_; }
};

/// Encodes bytes as base64.
std::string base64(const void* data, std::size_t bytes);

}  // namespace corpuscle
