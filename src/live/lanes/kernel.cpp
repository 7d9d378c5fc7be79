// Forces of frames on SIMD lanes. Compiled once for each instruction set, CORPUSCLE_ISA; what is made here must not leave this file but
// for one table.

#include "live/lanes/kernel.hpp"

#include <cstdint>

#include "signal/number.hpp"

namespace corpuscle::lanes {
namespace {

using T = num::Lanes<double>;
constexpr std::size_t width = T::size;

T numbers(const double* at) { return T::load_unaligned(at); }
T numbers(const float* at) { return num::of_floats<double>(at); }
T numbers(const std::int16_t* at) { return num::of_words<double>(at); }

/// One vector; adds 1 to `bad` where there is no force.
template <class Value>
[[gnu::always_inline]] inline void take_some(const char* from, const FrameForce& of, double* force, T& bad) {
    const T f = (numbers(reinterpret_cast<const Value*>(from)) - T(of.offset)) * T(of.scale);
    const auto good = num::abs(f) <= T(of.limit);
    num::select(good, f, T::load_unaligned(force)).store_unaligned(force);
    bad = bad + num::select(good, T(0.0), T(1.0));
}

template <class Value>
std::size_t take(const char* from, const FrameForce& of, double* force, std::size_t count) {
    T bad(0.0);
    std::size_t s = 0;
    for (; s + width <= count; s += width) take_some<Value>(from + s * sizeof(Value), of, force + s, bad);
    if (s < count) {
        alignas(64) Value last[width] = {};
        alignas(64) double forces[width] = {};
        T strange(0.0);
        __builtin_memcpy(last, from + s * sizeof(Value), (count - s) * sizeof(Value));
        __builtin_memcpy(forces, force + s, (count - s) * sizeof(double));
        take_some<Value>(reinterpret_cast<const char*>(last), of, forces, strange);
        __builtin_memcpy(force + s, forces, (count - s) * sizeof(double));
        strange.store_aligned(forces);
        for (std::size_t k = count - s; k < width; ++k) forces[k] = 0;
        bad = bad + T::load_aligned(forces);
    }
    alignas(64) double each[width];
    bad.store_aligned(each);
    std::size_t all = 0;
    for (const double b : each) all += static_cast<std::size_t>(b);
    return all;
}

}  // namespace

namespace CORPUSCLE_ISA {
const FrameLanes frames{take<float>, take<double>, take<std::int16_t>};
}

}  // namespace corpuscle::lanes
