#pragma once
// The functions of number.hpp and elementary.hpp on SIMD lanes, with one evaluation for each instruction set; inputs and outputs are
// arrays.

#include <cstddef>

namespace corpuscle::test {

inline constexpr std::size_t function_count = 15;  ///< in the order of number_functions.hpp

/// out[f][k] = function f of a[k] and b[k]. `count`, the length of the arrays, must be a multiple of 16; all arrays must be aligned to 64
/// bytes.
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
