#pragma once
// A clock that never jumps, in nanoseconds since an arbitrary time.

#include <chrono>
#include <cstdint>
#include <limits>

namespace corpuscle {

/// The time, ns.
inline std::int64_t steady_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A time that steady_now() does not reach: never.
inline constexpr std::int64_t steady_never = std::numeric_limits<std::int64_t>::max();

}  // namespace corpuscle
