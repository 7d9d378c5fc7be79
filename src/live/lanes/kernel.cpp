// Converts the values of frames to forces on SIMD lanes. The file is compiled once for each instruction set, CORPUSCLE_ISA. Only the table
// at its end may be visible to the linker.

#include "live/lanes/kernel.hpp"

#include "core/number/number.hpp"

namespace corpuscle::lanes {
namespace {

using T = num::Lanes<double>;
constexpr std::size_t width = T::size;

/// The values at `at`, converted to double.
T numbers(const double* at) { return T::load_unaligned(at); }
T numbers(const float* at) { return num::load_float<double>(at); }
T numbers(const std::int16_t* at) { return num::load_int16<double>(at); }

/// Converts one vector of values; adds 1 to the lanes of `bad` whose value is not a valid force.
template <class Value, bool is_simple>
[[gnu::always_inline]] inline void read_vector(const char* from, const ForceScaling& scaling, double* force, T& bad) {
    T x = numbers(reinterpret_cast<const Value*>(from));
    if (!is_simple && scaling.absolute) x = num::abs(x);
    const T f = (x - T(scaling.offset)) * T(scaling.scale);
    auto good = num::abs(f) <= T(scaling.limit);
    if (!is_simple) good = good & (x >= T(scaling.low)) & (x <= T(scaling.high));
    num::select(good, f, T::load_unaligned(force)).store_unaligned(force);
    bad = bad + num::select(good, T(0.0), T(1.0));
}

/// `is_simple`: the scaling has neither absolute values nor a lowest or highest value.
template <class Value, bool is_simple>
std::size_t convert_all(const char* from, const ForceScaling& scaling, double* force, std::size_t count) {
    T bad(0.0);
    std::size_t s = 0;
    for (; s + width <= count; s += width) read_vector<Value, is_simple>(from + s * sizeof(Value), scaling, force + s, bad);
    if (s < count) {  // the last values do not fill a vector: they are copied to one
        alignas(64) Value last[width] = {};
        alignas(64) double forces[width] = {};
        T last_bad(0.0);
        __builtin_memcpy(last, from + s * sizeof(Value), (count - s) * sizeof(Value));
        __builtin_memcpy(forces, force + s, (count - s) * sizeof(double));
        read_vector<Value, is_simple>(reinterpret_cast<const char*>(last), scaling, forces, last_bad);
        __builtin_memcpy(force + s, forces, (count - s) * sizeof(double));
        last_bad.store_aligned(forces);
        for (std::size_t k = count - s; k < width; ++k) forces[k] = 0;
        bad = bad + T::load_aligned(forces);
    }
    alignas(64) double each[width];
    bad.store_aligned(each);
    std::size_t total = 0;
    for (const double b : each) total += static_cast<std::size_t>(b);
    return total;
}

template <class Value>
std::size_t convert(const char* from, const ForceScaling& scaling, double* force, std::size_t count) {
    const bool is_simple = !scaling.absolute && scaling.low == -__builtin_inf() && scaling.high == __builtin_inf();
    return is_simple ? convert_all<Value, true>(from, scaling, force, count) : convert_all<Value, false>(from, scaling, force, count);
}

}  // namespace

namespace CORPUSCLE_ISA {
const FrameKernels frame_kernels{convert<float>, convert<double>, convert<std::int16_t>};
}

}  // namespace corpuscle::lanes
