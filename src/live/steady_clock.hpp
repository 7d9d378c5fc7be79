#pragma once
// A monotonic clock, in nanoseconds.

#include <chrono>
#include <cstdint>
#include <limits>

namespace corpuscle {

inline std::int64_t steady_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline constexpr std::int64_t steady_never = std::numeric_limits<std::int64_t>::max();

}  // namespace corpuscle
