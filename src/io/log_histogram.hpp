#pragma once
// How often numbers of which size came, in little memory: four bins an octave, from 2^-44 to 2^20.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

namespace corpuscle {

class LogHistogram {
    static constexpr std::int64_t bins = 256, lowest = (std::int64_t{1023 - 44}) << 2;
    std::array<std::uint32_t, bins> counts_{};

    /// The exponent and the first two digits of the mantissa; 0 and less are in bin 0.
    static std::size_t bin(double x) {
        if (!(x > 0)) return 0;
        const auto key = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 50) - lowest;
        return static_cast<std::size_t>(std::clamp<std::int64_t>(key, 0, bins - 1));
    }

public:
    void add(double x) { ++counts_[bin(x)]; }

    std::int64_t count() const { return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0}); }

    /// The lower edge of the bin in which the median of `all` numbers lies, those that were not added being 0; 0 for bin 0.
    double median(std::int64_t all) const {
        std::int64_t seen = all - count();
        std::size_t b = 0;
        while (b + 1 < counts_.size() && 2 * (seen += counts_[b]) < all) ++b;
        return b == 0 ? 0 : std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(b) + lowest) << 50);
    }

    /// How many are above x, but for those in its bin.
    std::int64_t above(double x) const {
        std::int64_t count = 0;
        for (std::size_t b = bin(x) + 1; b < counts_.size(); ++b) count += counts_[b];
        return count;
    }
};

}  // namespace corpuscle
