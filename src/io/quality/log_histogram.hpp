#pragma once
// A histogram of magnitudes in bounded memory: four bins per octave, from 2^-44 to 2^20. The first and the last bin also count smaller and
// larger numbers.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

namespace corpuscle {

class LogHistogram {
    static constexpr std::int64_t bins = 256;
    static constexpr std::int64_t first_key = (std::int64_t{1023 - 44}) << 2;  // key of bin 0: exponent and two mantissa bits of 2^-44
    std::array<std::uint32_t, bins> counts_{};

    /// The index of the bin of x. It is given by the exponent of x and the first two bits of its mantissa. Numbers <= 0 are in bin 0.
    static std::size_t bin(double x) {
        if (!(x > 0)) return 0;
        const auto key = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 50) - first_key;
        return static_cast<std::size_t>(std::clamp<std::int64_t>(key, 0, bins - 1));
    }

public:
    void add(double x) { ++counts_[bin(x)]; }

    /// The number of numbers added.
    std::int64_t count() const { return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0}); }

    /// The median of `all` numbers: those that were added, and zeros for the rest. Returns the lower edge of the bin that contains the
    /// median; 0 for bin 0.
    double median(std::int64_t all) const {
        std::int64_t seen = all - count();
        std::size_t b = 0;
        while (b + 1 < counts_.size() && 2 * (seen += counts_[b]) < all) ++b;
        return b == 0 ? 0 : std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(b) + first_key) << 50);
    }

    /// The middle of the bin below which this fraction of the numbers are; 0 for bin 0 and without numbers.
    double quantile(double fraction) const {
        const double wanted = fraction * static_cast<double>(count());
        std::int64_t seen = 0;
        for (std::size_t b = 0; b < counts_.size(); ++b) {
            seen += counts_[b];
            if (counts_[b] == 0 || static_cast<double>(seen) < wanted) continue;
            return b == 0 ? 0
                          : std::bit_cast<double>((static_cast<std::uint64_t>(static_cast<std::int64_t>(b) + first_key) << 50) +
                                                  (std::uint64_t{1} << 49));
        }
        return 0;
    }

    /// The number of numbers in the bins above the bin of x.
    std::int64_t count_above(double x) const {
        std::int64_t count = 0;
        for (std::size_t b = bin(x) + 1; b < counts_.size(); ++b) count += counts_[b];
        return count;
    }
};

}  // namespace corpuscle
