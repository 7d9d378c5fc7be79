#pragma once
// A signal of any length in bounded memory. Up to `max_points` samples are kept as they are. A longer signal is kept as the minimum and
// maximum of each bucket of consecutive samples, in at most `max_points` buckets. The bucket size doubles as the signal grows.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
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

/// Encodes bytes as base64.
std::string base64(std::span<const std::byte> bytes);
/// An array of numbers in a page's data: {"f32": base64}. web/base/arrays.ts reads it.
nlohmann::ordered_json array_document(std::span<const float>);
nlohmann::ordered_json array_document(std::span<const double>);
nlohmann::ordered_json array_document(std::span<const std::uint32_t>);
nlohmann::ordered_json array_document(std::span<const std::uint16_t>);
nlohmann::ordered_json array_document(std::span<const std::byte>);
/// True for the key of such an array.
bool is_array_type(std::string_view key);
/// The size of such an array in a page, bytes.
std::size_t encoded_size(const nlohmann::ordered_json& array);

/// A trace in the format of class Trace in web/panels/signals.ts. `channel`: its index, counted over all
/// inputs of the run. `afferent`: the name of the afferent, or null if the trace is the force.
nlohmann::ordered_json curve_document(std::uint32_t channel, const nlohmann::ordered_json& afferent, std::string_view quantity,
                                      std::string_view unit, const Envelope& values);

}  // namespace corpuscle
