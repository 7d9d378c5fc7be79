#pragma once
// What number.hpp and elementary.hpp offer, on the lanes of one instruction set: arrays in, arrays out.

#include <cstddef>

namespace corpuscle::test {

inline constexpr std::size_t functions = 15;

/// out[f][k] = function f of a[k] and b[k]; count is a multiple of 16, all on 64 bytes.
template <class V>
using NumberFunctions = void (*)(const V* a, const V* b, std::size_t count, V* const (&out)[functions]);

namespace baseline {
void in_double(const double* a, const double* b, std::size_t count, double* const (&out)[functions]);
void in_float(const float* a, const float* b, std::size_t count, float* const (&out)[functions]);
}  // namespace baseline
namespace avx2 {
void in_double(const double* a, const double* b, std::size_t count, double* const (&out)[functions]);
void in_float(const float* a, const float* b, std::size_t count, float* const (&out)[functions]);
}  // namespace avx2
namespace avx512 {
void in_double(const double* a, const double* b, std::size_t count, double* const (&out)[functions]);
void in_float(const float* a, const float* b, std::size_t count, float* const (&out)[functions]);
}  // namespace avx512

}  // namespace corpuscle::test
