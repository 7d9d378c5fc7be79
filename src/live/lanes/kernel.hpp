#pragma once
// Between frames, compiled for every machine, and their forces on SIMD lanes, compiled once for each instruction set: plain data and
// pointers only.

#include <cstddef>

#include "signal/instruction_set.hpp"

namespace corpuscle::lanes {

/// Forces out of what is read: (x - offset) * scale, unless that is no number or further from 0 than `limit`.
struct FrameForce {
    double offset, scale, limit;
};

/// What one instruction set offers: `count` values from `from`, in place of the forces that were, which stay where there is none.
/// Returns how many of those there are.
struct FrameLanes {
    using Take = std::size_t (*)(const char* from, const FrameForce&, double* force, std::size_t count);
    Take f32, f64, i16;
};

namespace baseline {
extern const FrameLanes frames;
}
namespace avx2 {
extern const FrameLanes frames;
}
namespace avx512 {
extern const FrameLanes frames;
}

inline const FrameLanes& frame_lanes(InstructionSet set) {
#ifdef __x86_64__
    if (set == InstructionSet::avx512) return avx512::frames;
    if (set == InstructionSet::avx2) return avx2::frames;
#endif
    (void)set;
    return baseline::frames;
}

}  // namespace corpuscle::lanes
