#pragma once
// Interface between circuit code, compiled for every machine, and transistor kernels on SIMD lanes, compiled once for each instruction
// set. Plain data and pointers only.

#include <cstddef>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t max_lanes = 8;  ///< a multiple of the number of lanes of every instruction set

/// A batch of transistors. Every array has rows of `stride` numbers, one for each transistor, and is aligned to 64 bytes. The unknowns are
/// drain, gate, source, bulk.
struct TransistorCall {
    const std::byte* models;    ///< from build(), one for each register of transistors
    std::size_t count, stride;  ///< number of transistors; the stride is at least this, rounded up to the number of lanes
    const double* v;            ///< [4][stride], V
    double gmin;                ///< S, in parallel with every junction
    double *f, *df;             ///< [4][stride], A; [4 * 4][stride], S
    double* max_term;           ///< [4][stride], A: for each terminal's current i, the largest |di/dv| max(|v|, phi_t); null: not needed
    double *q, *dq;             ///< charges and capacitances, same shapes; null: not needed
    double rate;                ///< 1/s: f and df are returned with rate times q and dq added
};

/// The transistor kernels of one instruction set.
struct TransistorKernels {
    std::size_t lanes, model_bytes;  ///< number of lanes; size of a model, which holds one transistor per lane
    void (*build)(std::byte* to, const UicmConstants* constants);  ///< constructs a model from one element of `constants` per lane
    void (*eval)(const TransistorCall&);
    void (*extrapolate)(std::size_t stride, const double* dv, const double* dq, double* q);  ///< q += dq dv for the whole stride
};

extern const TransistorKernels scalar_transistor_kernels;
namespace baseline {
extern const TransistorKernels transistor_kernel_table;
}
namespace avx2 {
extern const TransistorKernels transistor_kernel_table;
}
namespace avx512 {
extern const TransistorKernels transistor_kernel_table;
}

}  // namespace corpuscle::circuit::lanes
