#include "circuit/expression/spice_number.hpp"

#include <fmt/format.h>
#include <limits>

#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return lower(c) >= 'a' && lower(c) <= 'z'; }

/// The length of the digits with at most one point; 0 if there are no digits.
std::size_t mantissa_length(std::string_view s) {
    std::size_t n = 0;
    bool point = false;
    while (n < s.size() && (is_digit(s[n]) || (s[n] == '.' && !point))) point |= s[n++] == '.';
    return n > (point ? 1 : 0) ? n : 0;
}

/// The length of an exponent such as "e-9", "E+3" or "d5"; 0 if the text is not an exponent but, for example, a unit.
std::size_t exponent_length(std::string_view s) {
    if (s.empty() || (lower(s[0]) != 'e' && lower(s[0]) != 'd')) return 0;
    std::size_t n = 1;
    if (n < s.size() && (s[n] == '+' || s[n] == '-')) ++n;
    const auto first = n;
    while (n < s.size() && is_digit(s[n])) ++n;
    return n > first ? n : 0;
}

/// The value of the exponent "e-9"; 0 of "".
int exponent_of(std::string_view s) {
    if (s.size() < 2) return 0;
    const bool minus = s[1] == '-';
    int value = 0;
    for (const char c : s)
        if (is_digit(c)) value = std::min(value * 10 + (c - '0'), 100000000);
    return minus ? -value : value;
}

/// The scale 10^power * factor.
struct Scale {
    int power = 0;
    double factor = 1;
};

Scale scale_of(std::string_view letters) {
    if (equal_ignoring_case(letters.substr(0, 3), "meg")) return {6};
    if (equal_ignoring_case(letters.substr(0, 3), "mil")) return {0, 25.4e-6};
    constexpr std::string_view names = "tgkmunpf";
    constexpr int powers[] = {12, 9, 3, -3, -6, -9, -12, -15};
    const auto k = letters.empty() ? std::string_view::npos : names.find(lower(letters[0]));
    return k == std::string_view::npos ? Scale{} : Scale{powers[k]};
}

/// Converts "10" with power -6 as the text "10e-6", which gives the nearest double. The product 10 * 1e-6 does not always.
double nearest_double(std::string_view mantissa, int power) {
    const std::string text = std::string(mantissa) + 'e' + std::to_string(power);
    double value = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc::result_out_of_range) return value;
    return power < 0 ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<SpiceNumber> parse_leading_number(std::string_view text) {
    const auto digits = mantissa_length(text);
    if (digits == 0) return {};
    const auto exponent = exponent_length(text.substr(digits)), start = digits + exponent;
    std::size_t end = start;
    while (end < text.size() && is_letter(text[end])) ++end;
    const auto letters = text.substr(start, end - start);
    const auto scale = scale_of(letters);
    const int power = exponent_of(text.substr(digits, exponent)) + scale.power;
    return SpiceNumber{nearest_double(text.substr(0, digits), power) * scale.factor, end, letters};
}

std::optional<SpiceNumber> parse_number(std::string_view text) {
    const bool sign = !text.empty() && (text[0] == '-' || text[0] == '+');
    auto number = parse_leading_number(text.substr(sign));
    if (!number || number->length + sign != text.size()) return {};
    if (sign && text[0] == '-') number->value = -number->value;
    number->length = text.size();
    return number;
}

std::optional<std::string> ambiguity(const SpiceNumber& number, std::string_view text) {
    const auto letters = lower(number.suffix);
    if (letters.size() < 2 || letters[0] != 'a' || letters.starts_with("am")) return {};
    const auto digits = text.substr(0, text.size() - number.suffix.size());
    return fmt::format("'{}': some simulators read 'a' as 1e-18 and others ignore it; write {}{}", text, digits,
                       digits.find_first_of("eEdD") == std::string_view::npos ? "e-18" : " with the intended exponent");
}

}  // namespace corpuscle::circuit
