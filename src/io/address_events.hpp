#pragma once
// Binary address events: a header with the clock and the meaning of the addresses, then 16 bytes for each spike (doc/events.md). All
// numbers are little-endian.
//
//     header  "corpaer1", i64 per, i64 seconds (a sample is seconds/per s), u32 runs, u32 bytes that follow. Then the runs of afferents.
//
//     a run   u32 first address, u32 stride, u32 first number (0 for a name without a number), u32 count, u32 letters, letters,
//             0 to 3 zeros
//
//     then    if bytes of the header remain: u32 runs of channels, and these runs, with the name of the channel of the addresses
//
//     spike   i64 step, u32 fraction of the step, u32 address
//
// The offset of a spike in its step is (fraction + 1) / 2^32, so its time is (step - 1 + offset) * seconds / per.

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "signal/spike.hpp"

namespace corpuscle::address_events {

static_assert(std::endian::native == std::endian::little, "structures are written as they are in memory");

inline constexpr std::string_view magic = "corpaer1";
inline constexpr std::size_t header_bytes = 32, run_bytes = 20, spike_bytes = 16;

/// Afferents with numbered names, such as sa1#1, sa1#2 ..., at addresses `stride` apart.
struct NameRun {
    std::uint32_t first_address = 0, stride = 1, first_number = 0, count = 1;
    std::string name;
};

struct EncodedSpike {
    std::int64_t step;
    std::uint32_t fraction, address;
};
static_assert(sizeof(EncodedSpike) == spike_bytes);

inline constexpr double fraction_scale = 4294967296.0;  // 2^32

inline std::uint32_t encode_offset(double offset) { return static_cast<std::uint32_t>(std::ceil(offset * fraction_scale) - 1); }
inline double decode_offset(std::uint32_t place) { return (static_cast<double>(place) + 1) / fraction_scale; }

}  // namespace corpuscle::address_events
