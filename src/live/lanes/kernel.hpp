#pragma once
// The interface between FrameDecoder, which is compiled once for all machines, and the conversion of a frame's values to forces on SIMD
// lanes (kernel.cpp), which is compiled once for each instruction set. It consists of plain data and pointers only.

#include <cstddef>

#include "core/number/instruction_set.hpp"

namespace corpuscle::lanes {

/// The conversion of a value x to a force in newtons: (x - offset) * scale. A force that is NaN or larger than `limit` (N) in magnitude is
/// not valid.
struct ForceScaling {
    double offset, scale, limit;
};

/// The functions of one instruction set, one for each type of value: float, double, 16-bit integer. They convert the `count` values at
/// `from`, and write those that are valid to `force`; its other elements are not changed. They return the number of values that are not
/// valid.
struct FrameKernels {
    using Convert = std::size_t (*)(const char* from, const ForceScaling&, double* force, std::size_t count);
    Convert f32, f64, i16;
};

namespace baseline {
extern const FrameKernels frames;
}
namespace avx2 {
extern const FrameKernels frames;
}
namespace avx512 {
extern const FrameKernels frames;
}

/// The functions for an instruction set.
inline const FrameKernels& frame_kernels(InstructionSet set) {
#ifdef __x86_64__
    if (set == InstructionSet::avx512) return avx512::frames;
    if (set == InstructionSet::avx2) return avx2::frames;
#endif
    (void)set;
    return baseline::frames;
}

}  // namespace corpuscle::lanes
