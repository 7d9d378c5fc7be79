#pragma once
// The separators and number format of a text file.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace corpuscle {

using Fields = std::vector<std::string_view>;

struct Dialect {
    char separator = ',';  ///< ' ' means any number of blanks
    bool decimal_comma = false;

    /// Detects the separator: a tab, otherwise a semicolon, a comma, or blanks. If the comma is not the separator, it is a decimal comma.
    static Dialect detect(std::string_view line);

    /// Splits a line into fields without surrounding blanks and quotes.
    void split(std::string_view line, Fields& out) const;

    /// Parses a finite number. With `any`, also infinities and NaN.
    bool parse_number(std::string_view field, double& value, bool any = false) const;

    /// A fast parser for the common form at `p`: a sign, up to fifteen digits and a point. Moves p after the number. Returns false, with
    /// p unspecified, for any other form, which parse_number() must parse. Eight bytes after `end` must be readable.
    bool parse_plain_number(const char*& p, const char* end, double& value) const;

private:
    bool ends_at(const char* p, const char* end) const {
        return p == end || (p < end && (*p == separator || (separator == ' ' && *p == '\t')));
    }
    bool parse_longer_number(const char*& p, const char* end, double& value) const;
};

inline constexpr double powers_of_ten[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Eight characters in one 64-bit word, to parse short numbers fast (SWAR: SIMD within a register). Digits are bytes 0 to 9, the first
/// character in the lowest byte.
struct SwarWord {
    std::uint64_t digits,
        non_digits;  ///< the high bit of each byte that is not a digit; above the first one, or above the second if the first is a decimal
                     ///< point, bits may be wrong

    explicit SwarWord(const char* p) {
        std::memcpy(&digits, p, 8);
        if constexpr (std::endian::native == std::endian::big) digits = __builtin_bswap64(digits);
        digits ^= 0x3030303030303030U;
        non_digits = ((digits + 0x7676767676767676U) | digits) & 0x8080808080808080U;
    }
    static int byte_index(std::uint64_t bits) { return std::countr_zero(bits) / 8; }  // 8 if there is none
    /// Removes the byte at index `at` and shifts those above it down.
    void remove_byte(int at) {
        const std::uint64_t below = (std::uint64_t{1} << (8 * at)) - 1;
        digits = (digits & below) | ((digits >> 8) & ~below);
    }
    /// The number formed by the first `count` digits, 1 to 8.
    std::uint64_t parse_digits(int count) const {
        std::uint64_t x = digits << (8 * (8 - count));
        x = (x * 10 + (x >> 8)) & 0x00ff00ff00ff00ffU;
        x = (x * 100 + (x >> 16)) & 0x0000ffff0000ffffU;
        return (x * 10000 + (x >> 32)) & 0xffffffffU;
    }
};

inline bool Dialect::parse_plain_number(const char*& p, const char* end, double& value) const {
    while (p < end && (*p == ' ' || (separator == ' ' && *p == '\t'))) ++p;
    const bool minus = p < end && *p == '-';
    p += minus;
    SwarWord eight(p);
    const int integer_digits = SwarWord::byte_index(eight.non_digits);
    const bool point = integer_digits < 8 && (p[integer_digits] == '.' || (decimal_comma && p[integer_digits] == ','));
    const int length = point ? SwarWord::byte_index(eight.non_digits & (eight.non_digits - 1)) : integer_digits;
    const char* const stop = p + length;
    double magnitude;
    if (length < 8) {
        if (length == point || !ends_at(stop, end)) return false;
        if (point) eight.remove_byte(integer_digits);
        // The digits fit into a double and the power of ten is exact, so one division gives the nearest double, as from_chars does.
        magnitude = static_cast<double>(eight.parse_digits(length - point)) / powers_of_ten[length - integer_digits - point];
        p = stop;
    } else if (!parse_longer_number(p, end, magnitude)) {
        return false;
    }
    value = minus ? -magnitude : magnitude;
    return true;
}

}  // namespace corpuscle
