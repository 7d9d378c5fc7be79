#pragma once
// The field separator and the number format of a text file.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace corpuscle {

/// The fields of one line, as views of it.
using Fields = std::vector<std::string_view>;

/// A field without blanks around it, and without double quotes around the rest.
std::string_view unquoted_field(std::string_view);

struct Dialect {
    char separator = ',';        ///< between fields; ' ' means any number of blanks or tabs
    bool decimal_comma = false;  ///< true: a comma in a number is read like a decimal point

    /// Detects the separator from a line of the table: a tab if there is one, otherwise a semicolon, otherwise a comma, otherwise blanks.
    /// If the comma is not the separator, it is read as a decimal comma.
    static Dialect detect(std::string_view line);

    /// Splits a line into its fields. Blanks and double quotes around a field are removed.
    void split(std::string_view line, Fields& out) const;

    /// Parses a field that is a number, and returns false if it is not. Infinities and NaN are numbers only with `any`.
    bool parse_number(std::string_view field, double& value, bool any = false) const;

    /// A fast parser for the common form of numbers: an optional minus sign, and up to fifteen digits with an optional decimal point. Reads
    /// the field at `p` in a line that ends at `end`, and moves p to the end of the number. For any other form it returns false with p
    /// unspecified; then call parse_number(). The eight bytes after `end` must be readable.
    bool parse_plain_number(const char*& p, const char* end, double& value) const;

private:
    /// True if a field ends at p.
    bool ends_at(const char* p, const char* end) const {
        return p == end || (p < end && (*p == separator || (separator == ' ' && *p == '\t')));
    }
    bool parse_longer_number(const char*& p, const char* end, double& value) const;
};

/// powers_of_ten[n] is 10^n, which a double holds exactly.
inline constexpr double powers_of_ten[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Eight characters in one 64-bit word, to parse short numbers fast (SWAR: SIMD within a register).
struct SwarWord {
    std::uint64_t digits;  ///< the first character in the lowest byte; a digit is a byte of value 0 to 9
    /// In each byte, the high bit is 1 if the character is not a digit. Only the bits up to the first such character are reliable, or up to
    /// the second one if the first is a decimal point or comma.
    std::uint64_t non_digits;

    explicit SwarWord(const char* p) {
        std::memcpy(&digits, p, 8);
        if constexpr (std::endian::native == std::endian::big) digits = __builtin_bswap64(digits);
        digits ^= 0x3030303030303030U;
        non_digits = ((digits + 0x7676767676767676U) | digits) & 0x8080808080808080U;
    }
    /// The index of the lowest byte that is not 0; 8 if all are 0.
    static int byte_index(std::uint64_t bits) { return std::countr_zero(bits) / 8; }
    /// Removes the byte at index `at` and shifts those above it down.
    void remove_byte(int at) {
        const std::uint64_t below = (std::uint64_t{1} << (8 * at)) - 1;
        digits = (digits & below) | ((digits >> 8) & ~below);
    }
    /// The number that the first `count` (1 to 8) digits form. Each of the three steps joins neighbouring groups of digits to groups twice
    /// as long.
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
    // The length of the number without its sign; 8 if it is longer than seven characters.
    const int length = point ? SwarWord::byte_index(eight.non_digits & (eight.non_digits - 1)) : integer_digits;
    const char* const stop = p + length;
    double magnitude;
    if (length < 8) {
        if (length == point || !ends_at(stop, end)) return false;
        if (point) eight.remove_byte(integer_digits);
        // The digits and the power of ten are exact in a double, so the division gives the nearest double, as from_chars does.
        magnitude = static_cast<double>(eight.parse_digits(length - point)) / powers_of_ten[length - integer_digits - point];
        p = stop;
    } else if (!parse_longer_number(p, end, magnitude)) {
        return false;
    }
    value = minus ? -magnitude : magnitude;
    return true;
}

}  // namespace corpuscle
