#pragma once
// The functions of number.hpp and elementary.hpp on the lanes of each instruction set: arrays in, arrays out.

#include <cstddef>

namespace corpuscle::test {

inline constexpr std::size_t function_count = 15;

/// out[f][k] = function f of a[k] and b[k]. count must be a multiple of 16, and all arrays aligned to 64 bytes.
template <class V>
using NumberFunctions = void (*)(const V* a, const V* b, std::size_t count, V* const (&out)[function_count]);

namespace baseline {
void evaluate_double(const double* a, const double* b, std::size_t count, double* const (&out)[function_count]);
void evaluate_float(const float* a, const float* b, std::size_t count, float* const (&out)[function_count]);
}  // namespace baseline
namespace avx2 {
void evaluate_double(const double* a, const double* b, std::size_t count, double* const (&out)[function_count]);
void evaluate_float(const float* a, const float* b, std::size_t count, float* const (&out)[function_count]);
}  // namespace avx2
namespace avx512 {
void evaluate_double(const double* a, const double* b, std::size_t count, double* const (&out)[function_count]);
void evaluate_float(const float* a, const float* b, std::size_t count, float* const (&out)[function_count]);
}  // namespace avx512

}  // namespace corpuscle::test
