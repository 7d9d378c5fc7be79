// The conversion of a frame to forces gives the same bits on every instruction set. It scales readings, and keeps the last force where a
// reading is not valid.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/random.hpp"
#include "live/lanes/kernel.hpp"

namespace corpuscle::lanes {
namespace {

/// Numbers of all sizes, both zeros, numbers beyond the limit, infinities and NaN.
template <class V>
std::vector<V> readings(std::size_t count) {
    std::vector<V> out(count);
    for (std::size_t k = 0; k < count; ++k) {
        if constexpr (std::numeric_limits<V>::is_integer) {
            out[k] = static_cast<V>(k * 7919);
        } else {
            const V special[] = {V(0), -V(0), std::numeric_limits<V>::infinity(), std::numeric_limits<V>::quiet_NaN(), V(1e9), V(-1e9)};
            out[k] = k % 3 == 0 ? special[k / 3 % 6] : static_cast<V>(10 * normal(1, 0, 0, k));
        }
    }
    return out;
}

/// The specification of the kernel (see ForceScaling), one number at a time.
template <class V>
std::size_t convert_scalar(const std::vector<V>& from, const ForceScaling& f, std::vector<double>& force) {
    std::size_t bad = 0;
    for (std::size_t k = 0; k < force.size(); ++k) {
        const double x = f.absolute ? std::abs(static_cast<double>(from[k])) : static_cast<double>(from[k]);
        const double newtons = (x - f.offset) * f.scale;
        if (newtons >= -f.limit && newtons <= f.limit && x >= f.low && x <= f.high)
            force[k] = newtons;
        else
            ++bad;
    }
    return bad;
}

template <class V>
void expect_same_on_every_instruction_set(FrameKernels::Convert FrameKernels::* convert) {
    for (const ForceScaling& f : {ForceScaling{0, 1, 1e6}, ForceScaling{0.25, -2e-3, 1e4}, ForceScaling{1, 2, 1e4, true},
                                  ForceScaling{0, 1, 1e6, false, -5, 12}, ForceScaling{3, 1, 1e6, true, 2, 9}})
        for (const std::size_t count : {1U, 3U, 4U, 7U, 8U, 16U, 17U, 333U}) {
            const auto from = readings<V>(count);
            std::vector<double> expected(count, -0.0);
            const auto bad = convert_scalar(from, f, expected);
            for (const auto set : instruction_sets()) {
                std::vector<double> force(count, -0.0);
                EXPECT_EQ((frame_kernels(set).*convert)(reinterpret_cast<const char*>(from.data()), f, force.data(), count), bad)
                    << name_of(set);
                EXPECT_EQ(std::memcmp(force.data(), expected.data(), count * sizeof(double)), 0) << name_of(set) << ", " << count;
            }
        }
}

TEST(FrameKernels, GiveTheSameBitsOnEveryInstructionSet) {
    expect_same_on_every_instruction_set<float>(&FrameKernels::f32);
    expect_same_on_every_instruction_set<double>(&FrameKernels::f64);
    expect_same_on_every_instruction_set<std::int16_t>(&FrameKernels::i16);
}

}  // namespace
}  // namespace corpuscle::lanes
