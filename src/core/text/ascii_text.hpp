#pragma once
// Short functions for ASCII text: blanks, case, numbers, splitting and joining.

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

inline std::string_view trimmed(std::string_view s) {
    while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
    while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
    return s;
}

/// Converts ASCII letters only, independently of the locale.
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

inline std::string lower(std::string_view s) {
    std::string out(s);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) { return lower(c); });
    return out;
}

/// The value of a text that is only a number, without blanks or a plus sign; nullopt for any other text.
template <class T>
std::optional<T> parse_bare_number(std::string_view text) {
    T value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

inline bool equal_ignoring_case(std::string_view a, std::string_view b) { return lower(a) == lower(b); }

/// The parts of a text between its separators, at least one.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const auto end = std::min(text.find(separator, at), text.size());
        parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

/// The texts with a separator between them.
std::string joined(std::span<const std::string_view> texts, std::string_view separator = ", ");
std::string joined(std::span<const std::string> texts, std::string_view separator = ", ");

}  // namespace corpuscle
