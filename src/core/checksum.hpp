#pragma once
// A checksum that detects damage. It is not secure against forgery.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace corpuscle {

/// A 64-bit checksum of a byte sequence, computed in words of eight bytes. Each step is a bijection of the checksum so far, so sequences of
/// equal length that differ in a single word never have the same checksum. Bytes after the last complete word are words of their own. The
/// bytes can therefore be added in several calls only if all calls but the last add a multiple of eight bytes.
class Checksum {
    std::uint64_t value_ = 0xcbf29ce484222325U;

    void add_word(std::uint64_t w) {
        value_ = (value_ ^ w) * 0x100000001b3U;
        value_ ^= value_ >> 32;
    }

public:
    void add(const void* data, std::size_t size) {
        const auto* at = static_cast<const unsigned char*>(data);
        for (std::uint64_t w = 0; size >= sizeof w; at += sizeof w, size -= sizeof w) {
            std::memcpy(&w, at, sizeof w);
            add_word(w);
        }
        for (; size > 0; ++at, --size) add_word(*at);
    }
    /// Adds the length of a text and the text, so that moving letters between two consecutive texts changes the checksum.
    void add(std::string_view text) {
        add_word(text.size());
        add(text.data(), text.size());
    }
    void add(std::uint64_t x) { add_word(x); }
    void add(double x) { add(&x, sizeof x); }
    std::uint64_t value() const { return value_; }
};

inline std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    Checksum sum;
    sum.add(bytes.data(), bytes.size());
    return sum.value();
}

}  // namespace corpuscle
