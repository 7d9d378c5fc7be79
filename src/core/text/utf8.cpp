#include "core/text/utf8.hpp"

#include <array>
#include <cstdint>

namespace corpuscle {
namespace {

/// The Unicode code points of the bytes 0x80 to 0x9f in Windows-1252, where it differs from Latin-1. The five undefined bytes stand for
/// themselves.
constexpr std::array<std::uint16_t, 32> windows_1252 = {
    0x20ac, 0x81,   0x201a, 0x192,  0x201e, 0x2026, 0x2020, 0x2021, 0x2c6, 0x2030, 0x160, 0x2039, 0x152, 0x8d, 0x17d, 0x8f,
    0x90,   0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014, 0x2dc, 0x2122, 0x161, 0x203a, 0x153, 0x9d, 0x17e, 0x178};

bool is_code_point(char32_t c) { return c <= 0x10ffff && (c < 0xd800 || c >= 0xe000); }

}  // namespace

std::optional<char32_t> take_code_point(std::string_view& text) {
    const auto next = [&] {
        const auto byte = static_cast<unsigned char>(text.front());
        return text.remove_prefix(1), byte;
    };
    // `more` is the number of bytes that follow the first one; -1 if no character begins with it.
    const auto first = next();
    const int more = first < 0x80                    ? 0
                     : first >= 0xc2 && first < 0xe0 ? 1
                     : first >= 0xe0 && first < 0xf0 ? 2
                     : first >= 0xf0 && first < 0xf5 ? 3
                                                     : -1;
    char32_t c = more <= 0 ? first : first & (0x3f >> more);
    int left = more;
    for (; left > 0 && !text.empty() && (static_cast<unsigned char>(text.front()) & 0xc0) == 0x80; --left) c = c << 6 | (next() & 0x3f);
    constexpr char32_t min_value[] = {0, 0x80, 0x800, 0x10000};  // by `more`; smaller code points have a shorter encoding
    if (more < 0 || left > 0 || c < min_value[more] || !is_code_point(c)) return {};
    return c;
}

void append_utf8(std::string& out, char32_t c) {
    if (!is_code_point(c)) c = 0xfffd;
    const int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    constexpr char32_t lead[] = {0, 0xc0, 0xe0, 0xf0};
    out.push_back(static_cast<char>(lead[more] | c >> 6 * more));
    for (int k = more; k-- > 0;) out.push_back(static_cast<char>(0x80 | (c >> 6 * k & 0x3f)));
}

bool is_utf8(std::string_view text) {
    while (!text.empty())
        if (!take_code_point(text)) return false;
    return true;
}

std::string to_utf8(std::string_view text) {
    if (is_utf8(text)) return std::string(text);
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned>(static_cast<unsigned char>(c));
        append_utf8(out, byte >= 0x80 && byte < 0xa0 ? windows_1252[byte - 0x80] : byte);
    }
    return out;
}

}  // namespace corpuscle
