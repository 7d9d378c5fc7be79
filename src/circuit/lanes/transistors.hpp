#pragma once
// Between a circuit, compiled for every machine, and its transistors on SIMD lanes, compiled once for each instruction set: plain
// data and pointers only.

#include <cstddef>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t widest = 8;  ///< lanes of any instruction set divide it

/// Transistors side by side. Every array has rows of `room` numbers, one a transistor, and stands on 64 bytes; unknowns are drain,
/// gate, source, bulk.
struct TransistorCall {
    const std::byte* models;
    std::size_t count, room;  ///< `room` is not below `count` rounded up to the lanes
    const double* v;          ///< [4][room], V
    double gmin;              ///< S, beside every junction
    double *f, *df;           ///< [4][room], A; [4 * 4][room], S
    double* most;             ///< [4][room], A: the largest slope of each row times its voltage, or phi_t if that is more; null: not asked
    double *q, *dq;           ///< charges and capacitances, the same; null: not asked
    double rate;              ///< 1/s: f and df are given with rate times q and dq added
};

/// What one instruction set offers.
struct TransistorLanes {
    std::size_t lanes, model_bytes;
    void (*build)(std::byte* at, const UicmConstants*);  ///< the models of as many transistors as there are lanes
    void (*eval)(const TransistorCall&);
    void (*follow)(std::size_t room, const double* dv, const double* dq, double* q);  ///< q += dq dv, of all `room`
};

extern const TransistorLanes one_by_one;
namespace baseline {
extern const TransistorLanes transistors;
}
namespace avx2 {
extern const TransistorLanes transistors;
}
namespace avx512 {
extern const TransistorLanes transistors;
}

}  // namespace corpuscle::circuit::lanes
