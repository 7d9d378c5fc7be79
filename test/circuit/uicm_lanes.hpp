#pragma once
// Evaluates many transistors at once on SIMD lanes, with one function for each instruction set; inputs and outputs are arrays.

#include <cstddef>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::test {

inline constexpr std::size_t uicm_value_count = 44;  ///< in the order of uicm_values.hpp

/// out[f][k] = value f of transistor k at its terminal voltages v[0][k] ... v[3][k] (drain, gate, source, bulk). `count`, the number of
/// transistors, must be a multiple of 8, and arrays must be aligned to 64 bytes.
using UicmBatchFunction = void (*)(const UicmConstants*, const double* const (&v)[4], std::size_t count,
                                   double* const (&out)[uicm_value_count]);

/// For timing: evaluates one transistor at `count` points, `rounds` times. Returns the sum of all results, so that the compiler does not
/// omit any.
using UicmTimingFunction = double (*)(const UicmConstants&, const double* const (&v)[4], std::size_t count, std::size_t rounds);

namespace baseline {
void uicm_evaluate_batch(const UicmConstants*, const double* const (&v)[4], std::size_t count, double* const (&out)[uicm_value_count]);
double uicm_evaluate_rounds(const UicmConstants&, const double* const (&v)[4], std::size_t count, std::size_t rounds);
}  // namespace baseline
namespace avx2 {
void uicm_evaluate_batch(const UicmConstants*, const double* const (&v)[4], std::size_t count, double* const (&out)[uicm_value_count]);
double uicm_evaluate_rounds(const UicmConstants&, const double* const (&v)[4], std::size_t count, std::size_t rounds);
}  // namespace avx2
namespace avx512 {
void uicm_evaluate_batch(const UicmConstants*, const double* const (&v)[4], std::size_t count, double* const (&out)[uicm_value_count]);
double uicm_evaluate_rounds(const UicmConstants&, const double* const (&v)[4], std::size_t count, std::size_t rounds);
}  // namespace avx512

}  // namespace corpuscle::circuit::test
