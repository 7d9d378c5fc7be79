#pragma once
// Random numbers that depend on what they are for, not on who drew them: Philox 4x32-10 (Salmon et al., "Parallel random
// numbers: as easy as 1, 2, 3", SC 2011). The key is the seed and the purpose, the counter says which draw.

#include <array>
#include <cstdint>
#include <string_view>

#include "signal/elementary.hpp"

namespace corpuscle {

using Words = std::array<std::uint32_t, 4>;

constexpr Words philox(Words counter, std::uint64_t key) {
    auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0], b = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(a)};
        k0 += 0x9E3779B9, k1 += 0xBB67AE85;
    }
    return counter;
}

/// A stream of random numbers for each name: FNV-1a, 64 bits.
constexpr std::uint64_t stream_of(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

/// 53 bits as a number in (0, 1).
constexpr double unit_interval(std::uint32_t high, std::uint32_t low) {
    return (static_cast<double>((std::uint64_t{high} << 21) | (low >> 11)) + 0.5) * 0x1p-53;
}

/// Draw number `index` of two independent standard normal deviates for (seed, unit, purpose), by Box and Muller.
struct Normals {
    double first, second;
};
inline Normals normals(std::uint64_t seed, std::uint32_t unit, std::uint32_t purpose, std::uint64_t index) {
    const Words w = philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), unit, purpose}, seed);
    const double u = unit_interval(w[0], w[1]), turns = unit_interval(w[2], w[3]);
    const double far = num::sqrt(-2.0 * num::log(u));
    return {far * num::cos_turns(turns), far * num::cos_turns(turns - 0.25)};
}
/// The first of them.
inline double normal(std::uint64_t seed, std::uint32_t unit, std::uint32_t purpose, std::uint64_t index) {
    return normals(seed, unit, purpose, index).first;
}

}  // namespace corpuscle
