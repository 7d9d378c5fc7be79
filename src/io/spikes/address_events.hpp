#pragma once
// Binary address events: a header with the clock and the meaning of the addresses, then 16 bytes for each spike (doc/events.md). All
// numbers are little-endian; i64 is a signed integer of 64 bits, u32 an unsigned one of 32 bits.
//
//     header    "corpaer1", i64 samples, i64 seconds (the clock has this number of samples in this number of seconds), u32 number of
//               runs of afferents, u32 number of bytes of the header after this field. Then the runs of afferents.
//
//     run       afferents with consecutive numbers at equidistant addresses: u32 first address, u32 stride of the addresses, u32 number of
//               the first afferent (0: the name has no number), u32 count of afferents, u32 length of the name in bytes, the name, 0 to 3
//               zero bytes (padding of the name to a multiple of 4 bytes)
//
//     channels  only if bytes of the header remain: u32 number of runs of channels, and these runs. All addresses of such a run are
//               afferents on one channel, and its name is the name of the channel.
//
//     spike     i64 step (sample index, see core/spike.hpp), u32 fraction, u32 address
//
// The offset of a spike in its step is (fraction + 1) / 2^32. Its time in s, counted from sample 0, is
// (step - 1 + offset) * seconds / samples.

#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/spike.hpp"

namespace corpuscle::address_events {

static_assert(std::endian::native == std::endian::little, "structures are written as they are in memory");

inline constexpr std::string_view magic = "corpaer1";
/// Sizes of the header before its runs, and of a spike.
inline constexpr std::size_t header_bytes = 32, spike_bytes = 16;

/// A run: afferents such as sa1#17, sa1#18 ..., at addresses that are `stride` apart; or the addresses of one channel.
struct NameRun {
    std::uint32_t first_address = 0, stride = 1;
    std::uint32_t first_number = 0;  ///< number of the first afferent, such as 17; 0: the name has no number
    std::uint32_t count = 1;         ///< addresses in the run
    std::string name;                ///< without the number: "sa1"
};

/// A spike as it is in the file.
struct EncodedSpike {
    std::int64_t step;
    std::uint32_t fraction, address;
};
static_assert(sizeof(EncodedSpike) == spike_bytes);

inline constexpr double fraction_scale = 4294967296.0;  // 2^32

/// encode_offset() rounds an offset in (0, 1] up to a multiple of 2^-32 and returns its fraction; decode_offset() is the inverse.
inline std::uint32_t encode_offset(double offset) { return static_cast<std::uint32_t>(std::ceil(offset * fraction_scale) - 1); }
inline double decode_offset(std::uint32_t fraction) { return (static_cast<double>(fraction) + 1) / fraction_scale; }

}  // namespace corpuscle::address_events
