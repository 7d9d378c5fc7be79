#pragma once
// Interface between circuit code, compiled for every machine, and transistor kernels on SIMD lanes, compiled once for each instruction
// set. Plain data and pointers only.

#include <cstddef>

#include "circuit/device/uicm_constants.hpp"
#include "core/number/instruction_set.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t max_lanes = 8;  ///< a multiple of the number of lanes of every instruction set

/// The stamps of several devices of one kind. The elements have the order of Stamp, but each element is a row of `stride` numbers, one for
/// each device, aligned to 64 bytes.
struct BatchStamp {
    std::size_t stride;  ///< at least the number of devices, rounded up to the number of lanes
    const double* v;     ///< values of the unknowns
    double *f, *df;
    double* max_term;  ///< for each f, the largest |df/dv| max(|v|, phi_t), the scale of its rounding error; null: not needed
    double *q, *dq;    ///< null: not needed
    double rate = 0;   ///< 1/s: rate q is added to f, and rate dq to df
};

/// A batch of transistors. The unknowns are drain, gate, source, bulk.
struct TransistorCall : BatchStamp {
    const std::byte* models;  ///< from build(), one for each register of transistors
    std::size_t count;        ///< number of transistors
    double gmin;              ///< S, in parallel with every junction
};

/// The transistor kernels of one instruction set.
struct TransistorKernels {
    std::size_t lanes, model_bytes;  ///< number of lanes; size of a model, which holds one transistor per lane
    void (*build)(std::byte* to, const UicmConstants* constants);  ///< constructs a model from one element of `constants` per lane
    void (*eval)(const TransistorCall&);
    void (*extrapolate)(std::size_t stride, const double* dv, const double* dq, double* q);  ///< q += dq dv for the whole stride
};

extern const TransistorKernels scalar_transistor_kernels;
CORPUSCLE_KERNELS(TransistorKernels, transistor_kernel_table)

}  // namespace corpuscle::circuit::lanes
