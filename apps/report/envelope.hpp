#pragma once
// A signal of any length in bounded memory. Up to `max_points` samples are kept as they are. A longer signal is kept as the minimum and
// maximum of each bucket of consecutive samples, in at most `max_points` buckets. The bucket size doubles as the signal grows.

#include <cstdint>
#include <string>
#include <vector>

namespace corpuscle {

class Envelope {
    std::vector<float> values_;    // the samples if bucket_ is 1; else min, max, min, max ...
    std::int64_t bucket_ = 1;      // samples per bucket, a power of two
    std::int64_t last_count_ = 0;  // samples in the last bucket so far; not used while bucket_ is 1
    std::size_t max_points_;

    void double_bucket();

public:
    explicit Envelope(std::size_t max_points = std::size_t{1} << 20) : max_points_(max_points) {}
    void add(double value);
    /// Samples per bucket.
    std::int64_t bucket() const { return bucket_; }
    /// The number of samples kept if bucket() is 1, else the number of pairs of minimum and maximum.
    std::size_t count() const { return bucket_ == 1 ? values_.size() : values_.size() / 2; }
    /// The samples if bucket() is 1, else min, max, min, max ...
    const std::vector<float>& values() const { return values_; }
};

/// Encodes `bytes` bytes at `data` as base64.
std::string base64(const void* data, std::size_t bytes);

}  // namespace corpuscle
