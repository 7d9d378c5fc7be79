#pragma once
// A checksum against damage, not against forgery.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace corpuscle {

/// 64 bits over a sequence of bytes, eight at a time. Each step is a bijection of the value so far, so bytes that differ in one word
/// alone never have the same checksum. Of bytes that are added in pieces, all pieces but the last are multiples of eight bytes.
class Checksum {
    std::uint64_t value_ = 0xcbf29ce484222325U;

    void word(std::uint64_t w) {
        value_ = (value_ ^ w) * 0x100000001b3U;
        value_ ^= value_ >> 32;
    }

public:
    void add(const void* data, std::size_t size) {
        const auto* at = static_cast<const unsigned char*>(data);
        for (std::uint64_t w = 0; size >= sizeof w; at += sizeof w, size -= sizeof w) {
            std::memcpy(&w, at, sizeof w);
            word(w);
        }
        for (; size > 0; ++at, --size) word(*at);
    }
    /// A text with its length, so that neighbours cannot trade letters.
    void add(std::string_view text) {
        word(text.size());
        add(text.data(), text.size());
    }
    void add(std::uint64_t x) { word(x); }
    void add(double x) { add(&x, sizeof x); }
    std::uint64_t value() const { return value_; }
};

inline std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    Checksum sum;
    sum.add(bytes.data(), bytes.size());
    return sum.value();
}

}  // namespace corpuscle
