#pragma once
// How a file of text separates its fields and writes its numbers.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace corpuscle {

using Fields = std::vector<std::string_view>;

struct Dialect {
    char separator = ',';  ///< ' ' stands for any run of blanks
    bool decimal_comma = false;

    /// A tab, else a semicolon, else a comma, else blanks; a comma is a decimal one where it does not separate.
    static Dialect of(std::string_view line);

    /// The fields of a line, without blanks and quotes about them.
    void split(std::string_view line, Fields& out) const;

    /// A finite number; `any` takes infinities and NaN, too.
    bool number(std::string_view field, double& value, bool any = false) const;

    /// The number that begins at `p`, as most are written: a sign, up to fifteen digits and a point. Moves p behind it. False, and p
    /// anywhere, where number() must have a closer look. Eight bytes from `end` on must be readable.
    bool plain_number(const char*& p, const char* end, double& value) const;

private:
    bool ends_at(const char* p, const char* end) const {
        return p == end || (p < end && (*p == separator || (separator == ' ' && *p == '\t')));
    }
    bool longer_number(const char*& p, const char* end, double& value) const;
};

inline constexpr double powers_of_ten[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Eight characters at once, for the shortest numbers are the most: digits as bytes 0 to 9, the first in the lowest.
struct EightCharacters {
    std::uint64_t digits,
        others;  ///< others: the high bit of each byte that is no digit; right up to the first, and to a second behind a point

    explicit EightCharacters(const char* p) {
        std::memcpy(&digits, p, 8);
        if constexpr (std::endian::native == std::endian::big) digits = __builtin_bswap64(digits);
        digits ^= 0x3030303030303030U;
        others = ((digits + 0x7676767676767676U) | digits) & 0x8080808080808080U;
    }
    static int place(std::uint64_t bits) { return std::countr_zero(bits) / 8; }  // 8: none
    /// The first byte goes out, those above it move down.
    void close_up(int at) {
        const std::uint64_t below = (std::uint64_t{1} << (8 * at)) - 1;
        digits = (digits & below) | ((digits >> 8) & ~below);
    }
    /// The number that the first `count` digits make, 1 to 8.
    std::uint64_t number(int count) const {
        std::uint64_t x = digits << (8 * (8 - count));
        x = (x * 10 + (x >> 8)) & 0x00ff00ff00ff00ffU;
        x = (x * 100 + (x >> 16)) & 0x0000ffff0000ffffU;
        return (x * 10000 + (x >> 32)) & 0xffffffffU;
    }
};

inline bool Dialect::plain_number(const char*& p, const char* end, double& value) const {
    while (p < end && (*p == ' ' || (separator == ' ' && *p == '\t'))) ++p;
    const bool minus = p < end && *p == '-';
    p += minus;
    EightCharacters eight(p);
    const int whole = EightCharacters::place(eight.others);
    const bool point = whole < 8 && (p[whole] == '.' || (decimal_comma && p[whole] == ','));
    const int length = point ? EightCharacters::place(eight.others & (eight.others - 1)) : whole;
    const char* const stop = p + length;
    double size;
    if (length < 8) {
        if (length == point || !ends_at(stop, end)) return false;
        if (point) eight.close_up(whole);
        // Digits that a double holds and one division by an exact power of ten: the nearest double, as from_chars gives it.
        size = static_cast<double>(eight.number(length - point)) / powers_of_ten[length - whole - point];
        p = stop;
    } else if (!longer_number(p, end, size)) {
        return false;
    }
    value = minus ? -size : size;
    return true;
}

}  // namespace corpuscle
