#pragma once
// Evaluates many transistors at once on the SIMD lanes of one instruction set; inputs and outputs are arrays.

#include <cstddef>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::test {

inline constexpr std::size_t uicm_value_count = 44;  ///< i, q, di, dq of an evaluation, then the four noise densities

/// out[f][k] = value f of transistor k at the voltages v[0...3][k]. `count` must be a multiple of 8, arrays aligned to 64 bytes.
using UicmBatchFunction = void (*)(const UicmConstants*, const double* const (&v)[4], std::size_t count,
                                   double* const (&out)[uicm_value_count]);

/// For timing: evaluates one transistor at all points, `rounds` times. Returns the sum of all results, so that none is optimized away.
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
