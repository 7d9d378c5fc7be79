#pragma once
// Counter-based random numbers: Philox 4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011). A random number
// is a function of the seed (Philox's key) and of index, stream and purpose (together Philox's counter), so the order of the calls does not
// matter.

#include <array>

#include "core/checksum.hpp"
#include "core/number/elementary.hpp"

namespace corpuscle {

using PhiloxCounter = std::array<std::uint32_t, 4>;

/// Four random words for this counter and key. The constants are those of the publication.
constexpr PhiloxCounter philox(PhiloxCounter counter, std::uint64_t key) {
    auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0], b = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(a)};
        k0 += 0x9E3779B9, k1 += 0xBB67AE85;
    }
    return counter;
}

/// A hash of a name (FNV-1a, 64 bits). Its lower 32 bits serve as the `purpose` of normal(), so that quantities of different names have
/// independent random numbers.
constexpr std::uint64_t stream_id(std::string_view name) {
    Fnv1a hash;
    hash.add(name);
    return hash.value;
}

/// Maps the upper 53 of 64 random bits to a number in (0, 1); neither 0 nor 1 occurs.
constexpr double unit_interval(std::uint32_t high, std::uint32_t low) {
    return (static_cast<double>((std::uint64_t{high} << 21) | (low >> 11)) + 0.5) * 0x1p-53;
}

/// Two independent standard normal deviates.
struct NormalPair {
    double first, second;
};
/// The deviates number `index` of the sequence that (seed, stream, purpose) selects, by the Box-Muller transform. `stream` is usually the
/// number of an afferent or copy; `purpose` tells apart the sequences of one stream, such as noise and mismatch.
inline NormalPair normal_pair(std::uint64_t seed, std::uint32_t stream, std::uint32_t purpose, std::uint64_t index) {
    const PhiloxCounter w = philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), stream, purpose}, seed);
    const double u = unit_interval(w[0], w[1]), turns = unit_interval(w[2], w[3]);
    const double radius = num::sqrt(-2.0 * num::log(u));
    return {radius * num::cos_turns(turns), radius * num::cos_turns(turns - 0.25)};  // the second is a sine
}
/// The first deviate of normal_pair().
inline double normal(std::uint64_t seed, std::uint32_t stream, std::uint32_t purpose, std::uint64_t index) {
    return normal_pair(seed, stream, purpose, index).first;
}

}  // namespace corpuscle
