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
    bool absolute = false;                                  ///< true: x is the absolute value of the reading
    double low = -__builtin_inf(), high = __builtin_inf();  ///< lowest and highest valid x
};

/// The functions of one instruction set, one for each type of value: float, double, 16-bit integer. They convert the `count` values at
/// `from`, and write those that are valid to `force`; its other elements are not changed. They return the number of values that are not
/// valid.
struct FrameKernels {
    using Convert = std::size_t (*)(const char* from, const ForceScaling&, double* force, std::size_t count);
    Convert f32, f64, i16;
};

CORPUSCLE_KERNELS(FrameKernels, frame_kernels)

}  // namespace corpuscle::lanes
