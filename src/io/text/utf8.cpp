#include "io/text/utf8.hpp"

#include <array>
#include <cstdint>

namespace corpuscle {
namespace {

/// The Unicode code points of the bytes 0x80 to 0x9f in Windows-1252, where it differs from Latin-1. The five undefined bytes stand for
/// themselves.
constexpr std::array<std::uint16_t, 32> windows_1252 = {
    0x20ac, 0x81,   0x201a, 0x192,  0x201e, 0x2026, 0x2020, 0x2021, 0x2c6, 0x2030, 0x160, 0x2039, 0x152, 0x8d, 0x17d, 0x8f,
    0x90,   0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014, 0x2dc, 0x2122, 0x161, 0x203a, 0x153, 0x9d, 0x17e, 0x178};

/// Appends a code point up to U+FFFF as UTF-8.
void append_character(std::string& out, unsigned code) {
    const auto byte = [&](unsigned b) { out += static_cast<char>(b); };
    if (code < 0x80) return byte(code);
    if (code < 0x800) return byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f));
    byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 0x3f)), byte(0x80 | (code & 0x3f));
}

}  // namespace

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(text[at + k])); };
        // Length of the sequence that byte 0 begins; 0 if no sequence begins with it.
        const std::size_t bytes = byte(0) < 0x80 ? 1 : byte(0) < 0xc2 || byte(0) > 0xf4 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
        if (bytes == 0 || text.size() - at < bytes) return false;
        for (std::size_t k = 1; k < bytes; ++k)
            if ((byte(k) & 0xc0) != 0x80) return false;
        if (bytes > 2) {  // rejects overlong encodings, surrogates, and code points above U+10FFFF
            const auto second = byte(1);
            if ((byte(0) == 0xe0 && second < 0xa0) || (byte(0) == 0xed && second > 0x9f) || (byte(0) == 0xf0 && second < 0x90) ||
                (byte(0) == 0xf4 && second > 0x8f))
                return false;
        }
        at += bytes;
    }
    return true;
}

std::string to_utf8(std::string_view text) {
    if (is_utf8(text)) return std::string(text);
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned>(static_cast<unsigned char>(c));
        append_character(out, byte >= 0x80 && byte < 0xa0 ? windows_1252[byte - 0x80] : byte);
    }
    return out;
}

}  // namespace corpuscle
