#pragma once
// Binary address events: a header with the clock and the meaning of the addresses, then 16 bytes for each spike (doc/events.md). All
// numbers are little-endian.
//
//     header    "corpaer1", i64 samples, i64 seconds (the clock has this number of samples in this number of seconds), u32 number of
//               runs of afferents, u32 bytes of the header after this number. Then the runs of afferents.
//
//     run       u32 first address, u32 stride, u32 first number (0 for a name without a number), u32 count, u32 bytes of the name, the
//               name, 0 to 3 zero bytes (padding to a multiple of 4)
//
//     channels  only if bytes of the header remain: u32 number of runs of channels, and these runs. The name of a run is the channel of
//               its addresses.
//
//     spike     i64 step, u32 fraction of the step, u32 address
//
// The offset of a spike in its step is (fraction + 1) / 2^32, so its time is (step - 1 + offset) * seconds / samples.

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
inline double decode_offset(std::uint32_t fraction) { return (static_cast<double>(fraction) + 1) / fraction_scale; }

}  // namespace corpuscle::address_events
