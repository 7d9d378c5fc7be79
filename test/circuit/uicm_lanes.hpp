#pragma once
// Many transistors on the lanes of one instruction set: arrays in, arrays out.

#include <cstddef>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::test {

inline constexpr std::size_t uicm_value_count = 44;  ///< i, q, di, dq of an answer, then the four noises

/// out[f][k] = number f of transistor k at v[0...3][k]; count is a multiple of 8, all v and out on 64 bytes.
using UicmBatchFunction = void (*)(const UicmConstants*, const double* const (&v)[4], std::size_t count, double* const (&out)[uicm_value_count]);

/// The time of it: `rounds` times the same transistor at all points; the sum of all that came out, so that nothing can be left out.
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
