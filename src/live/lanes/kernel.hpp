#pragma once
// The interface between frames, compiled for every machine, and the conversion of their forces on SIMD lanes, compiled once for each
// instruction set. It consists of plain data and pointers only.

#include <cstddef>

#include "signal/instruction_set.hpp"

namespace corpuscle::lanes {

/// Converts values to forces: (x - offset) * scale. A result that is NaN or larger than `limit` in magnitude is not valid.
struct ForceScaling {
    double offset, scale, limit;
};

/// The functions of one instruction set. They read `count` values from `from` and overwrite the last forces, except where a value is not
/// valid. They return the number of values that are not valid.
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

inline const FrameKernels& frame_kernels(InstructionSet set) {
#ifdef __x86_64__
    if (set == InstructionSet::avx512) return avx512::frames;
    if (set == InstructionSet::avx2) return avx2::frames;
#endif
    (void)set;
    return baseline::frames;
}

}  // namespace corpuscle::lanes
