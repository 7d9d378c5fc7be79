#pragma once
// Parts of the C++20 library that the libc++ of Debian's emscripten (version 13 of Debian 12, 18 of Debian 13) does not have. Included before
// every file. Only the forms that src/ uses are here; a newer library has them all, and then this file defines nothing.

#include <bit>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}
}  // namespace std
#endif

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000
#include "old_ranges.hpp"
#endif
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include "old_from_chars.hpp"
#endif
