#pragma once
// Functions for text that the user typed: removal of blanks around it, and comparison without regard to case.

#include <algorithm>
#include <string>
#include <string_view>

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

inline bool equal_ignoring_case(std::string_view a, std::string_view b) { return lower(a) == lower(b); }

}  // namespace corpuscle
