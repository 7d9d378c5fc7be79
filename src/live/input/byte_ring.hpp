#pragma once
// Passes bytes from one thread to another without a lock: a ring buffer of fixed size with one writer and one reader. Both may be the same
// thread.

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

namespace corpuscle {

class ByteRing {
    alignas(64) std::atomic<std::size_t> put_ = 0;  // number of bytes written so far; modulo the size it is the index of the next one
    std::vector<char> bytes_;
    alignas(64) std::atomic<std::size_t> taken_ = 0;  // number of bytes read so far

public:
    /// The size is at least `min_size` bytes, rounded up to a power of two.
    explicit ByteRing(std::size_t min_size) : bytes_(std::bit_ceil(std::max<std::size_t>(min_size, 64))) {}
    std::size_t size() const { return bytes_.size(); }
    std::size_t total_put() const { return put_.load(std::memory_order_acquire); }
    std::size_t total_taken() const { return taken_.load(std::memory_order_acquire); }
    /// Number of bytes that have been written and not yet read.
    std::size_t filled() const { return put_.load(std::memory_order_acquire) - taken_.load(std::memory_order_acquire); }

    bool has_space(std::size_t bytes) const { return bytes <= bytes_.size() - filled(); }

    /// Writes all of the text and returns true, or writes nothing and returns false if it does not fit. For the writing thread only.
    bool put(std::string_view text) {
        const auto at = put_.load(std::memory_order_relaxed);
        if (text.size() > bytes_.size() - (at - taken_.load(std::memory_order_acquire))) return false;
        const auto begin = at & (bytes_.size() - 1), first = std::min(text.size(), bytes_.size() - begin);
        std::memcpy(bytes_.data() + begin, text.data(), first);
        std::memcpy(bytes_.data(), text.data() + first, text.size() - first);
        put_.store(at + text.size(), std::memory_order_release);
        return true;
    }

    /// The next bytes to read, as far as they are contiguous in memory; empty if there are none. For the reading thread only, as consume().
    std::string_view readable() const {
        const auto at = taken_.load(std::memory_order_relaxed), filled = put_.load(std::memory_order_acquire) - at;
        const auto begin = at & (bytes_.size() - 1);
        return {bytes_.data() + begin, std::min(filled, bytes_.size() - begin)};
    }
    /// Removes the first `bytes` bytes of readable().
    void consume(std::size_t bytes) { taken_.store(taken_.load(std::memory_order_relaxed) + bytes, std::memory_order_release); }
};

}  // namespace corpuscle
