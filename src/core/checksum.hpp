#pragma once
// Hashes of bytes and texts. They detect damage, but are not secure against forgery.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace corpuscle {

/// FNV-1a, 64 bits.
struct Fnv1a {
    std::uint64_t value = 0xcbf29ce484222325U;

    /// Adds a byte, or a number of 64 bits as if it were one. This changes only bits of the hash at or above the lowest bit set in the
    /// number; many doubles have their lowest 40 bits 0. For them use add(T) or Checksum.
    constexpr void add_word(std::uint64_t x) { value = (value ^ x) * 0x100000001b3U; }
    constexpr void add(std::string_view text) {
        for (const char c : text) add_word(static_cast<unsigned char>(c));
    }
    /// Adds the bytes of a number.
    template <class T>
        requires std::is_arithmetic_v<T>
    void add(T x) {
        add(std::string_view(reinterpret_cast<const char*>(&x), sizeof x));
    }
};

/// A 64-bit checksum of a byte sequence, computed in words of eight bytes. Each step is a bijection of the checksum so far, so sequences of
/// equal length that differ in a single word never have the same checksum. Bytes after the last complete word are words of their own. The
/// bytes can therefore be added in several calls only if all calls but the last add a multiple of eight bytes.
class Checksum {
    Fnv1a hash_;

    void add_word(std::uint64_t w) {
        hash_.add_word(w);
        hash_.value ^= hash_.value >> 32;
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
    std::uint64_t value() const { return hash_.value; }
};

inline std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    Checksum sum;
    sum.add(bytes.data(), bytes.size());
    return sum.value();
}

}  // namespace corpuscle
