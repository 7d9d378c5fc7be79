#pragma once
// A histogram of latencies, from nanoseconds to hours, in a fixed amount of memory. It has 32 bins per octave; from 32 ns on, the width of
// a bin is 1.6 to 3.1 % of the latency.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace corpuscle {

class LatencyHistogram {
    static constexpr int bins_per_octave = 32, bins = 44 * bins_per_octave;
    std::array<std::uint64_t, bins> counts_{};
    std::uint64_t count_ = 0;
    std::int64_t max_ = 0;  // ns

    /// The bin of a latency. The first 32 bins are 1 ns wide.
    static int bin_of(std::int64_t ns) {
        const auto n = static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0));
        if (n < bins_per_octave) return static_cast<int>(n);
        const int octave = static_cast<int>(std::bit_width(n)) - 6;  // 0 from 32 to 63 ns
        return std::min(bins - 1, (octave + 1) * bins_per_octave + static_cast<int>((n >> octave) - bins_per_octave));
    }

public:
    /// Adds a latency; a negative one counts as 0.
    void add(std::int64_t ns) { ++counts_[static_cast<std::size_t>(bin_of(ns))], ++count_, max_ = std::max(max_, ns); }
    std::uint64_t count() const { return count_; }
    std::int64_t max() const { return max_; }  ///< ns

    /// The upper end of a bin, ns; it belongs to the next bin.
    static std::int64_t end_of(int bin) {
        if (bin < bins_per_octave) return bin + 1;
        const int octave = bin / bins_per_octave - 1;
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(bin % bins_per_octave + bins_per_octave + 1) << octave);
    }
    static constexpr int bin_count() { return bins; }
    std::uint64_t count_in(int bin) const { return counts_[static_cast<std::size_t>(bin)]; }

    /// A quantile of the latencies, ns; `fraction` is 0.5 for the median. The result is the upper end of its bin, or the maximum if that is
    /// lower.
    std::int64_t quantile(double fraction) const {
        const auto rank = static_cast<std::uint64_t>(fraction * static_cast<double>(count_));
        std::uint64_t seen = 0;
        for (int b = 0; b < bins; ++b) {
            seen += count_in(b);
            if (seen > rank) return std::min(end_of(b), max_);
        }
        return max_;
    }
};

}  // namespace corpuscle
