#pragma once
// Numbers with a fixed number of decimals, for tables with many rows.

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <iterator>

namespace corpuscle {

/// Appends x with this number of decimals, at most 9: the same text as fmt's "{:.<decimals>f}", several times faster. The decimal number
/// nearest to x follows from x 10^decimals, unless that is large or close to the middle between two integers.
inline void append_fixed(fmt::memory_buffer& text, double x, int decimals) {
    constexpr double powers[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
    constexpr double max_scaled = 1e15, margin = 0.01;
    const double scaled = std::abs(x) * powers[decimals], below = std::floor(scaled);
    const double rest = scaled - below;
    if (!(scaled < max_scaled) || std::abs(rest - 0.5) < margin + 1e-15 * scaled) {
        fmt::format_to(std::back_inserter(text), "{:.{}f}", x, decimals);
        return;
    }
    const auto number = static_cast<std::uint64_t>(below) + (rest > 0.5 ? 1 : 0);
    if (std::signbit(x)) text.push_back('-');
    char digits[24];
    // At least one digit before the point.
    const auto unit = static_cast<std::uint64_t>(powers[decimals]);
    const auto whole = std::to_chars(digits, digits + sizeof digits, number / unit);
    text.append(digits, whole.ptr);
    if (decimals == 0) return;
    char fraction[10];
    auto left = number % unit;
    for (int k = decimals; k > 0; --k, left /= 10) fraction[k] = static_cast<char>('0' + left % 10);
    fraction[0] = '.';
    text.append(fraction, fraction + decimals + 1);
}

}  // namespace corpuscle
