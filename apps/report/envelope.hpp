#pragma once
// A trace of any length in bounded memory: the samples themselves, or, beyond `most`, the least and the greatest of each
// bucket of samples; buckets double as the trace grows.

#include <cstdint>
#include <string>
#include <vector>

namespace corpuscle {

class Envelope {
    std::vector<float> values_;  // bucket 1: samples; else least, greatest, least, greatest ...
    std::int64_t bucket_ = 1, in_last_ = 0;
    std::size_t most_;

    void double_bucket();

public:
    explicit Envelope(std::size_t most = std::size_t{1} << 20) : most_(most) {}
    void add(double value);
    std::int64_t bucket() const { return bucket_; }
    /// Samples, or pairs.
    std::size_t count() const { return bucket_ == 1 ? values_.size() : values_.size() / 2; }
    const std::vector<float>& values() const { return values_; }
};

/// Bytes as base64 text.
std::string base64(const void* data, std::size_t bytes);

}  // namespace corpuscle
