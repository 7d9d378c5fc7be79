#pragma once
// std::from_chars for double, by strtod, which rounds correctly in emscripten's C library.

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace std {

/// The end of the longest decimal number at the beginning of a text; `begin` if there is none. No sign but '-', no space, no "0x".
inline const char* end_of_decimal_number(const char* begin, const char* end) {
    const auto skip_digits = [&](const char* at) {
        while (at != end && *at >= '0' && *at <= '9') ++at;
        return at;
    };
    const char* const first = begin != end && *begin == '-' ? begin + 1 : begin;
    const char* at = skip_digits(first);
    auto digits = at - first;
    if (at != end && *at == '.') {
        const char* const fraction = at + 1;
        at = skip_digits(fraction);
        digits += at - fraction;
    }
    if (digits == 0) return begin;
    if (at == end || (*at != 'e' && *at != 'E')) return at;
    const char* const sign = at + 1;
    const char* const exponent = sign != end && (*sign == '-' || *sign == '+') ? sign + 1 : sign;
    const char* const last = skip_digits(exponent);
    return last == exponent ? at : last;
}

/// "inf", "infinity", "nan" and "nan(...)", with a sign, in any case: strtod reads them as from_chars does.
inline bool begins_infinite(const char* begin, const char* end) {
    if (begin != end && *begin == '-') ++begin;
    return end - begin >= 3 && (*begin == 'i' || *begin == 'I' || *begin == 'n' || *begin == 'N');
}

inline from_chars_result from_chars(const char* begin, const char* end, double& value) {
    const char* last = begins_infinite(begin, end) ? end : end_of_decimal_number(begin, end);
    if (last == begin) return {begin, errc::invalid_argument};
    const string number(begin, last);
    char* stopped = nullptr;
    const double read = strtod(number.c_str(), &stopped);
    if (stopped == number.c_str()) return {begin, errc::invalid_argument};
    const bool is_zero = number.substr(0, number.find_first_of("eE")).find_first_of("123456789") == string::npos;
    last = begin + (stopped - number.c_str());
    if (!begins_infinite(begin, end) && (!isfinite(read) || (read == 0 && !is_zero))) return {last, errc::result_out_of_range};
    value = read;
    return {last, errc()};
}

}  // namespace std
