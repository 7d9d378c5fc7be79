// The noise of a sensor: its size, and that forces and vibrations do not count as noise.

#include "io/quality/noise_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.hpp"

namespace corpuscle {
namespace {

double noise_of(const std::vector<double>& x, std::size_t block = 4096) {
    NoiseDetector detector;
    for (std::size_t k = 0; k < x.size(); k += block) detector.add(std::span(x).subspan(k, std::min(block, x.size() - k)));
    return detector.deviation();
}

template <class F>
std::vector<double> force_samples(std::size_t count, F f) {
    std::vector<double> out(count);
    for (std::size_t k = 0; k < count; ++k) out[k] = f(static_cast<double>(k));
    return out;
}

double white(double k) { return normal_pair(9, static_cast<std::uint32_t>(k), 1, 0).first; }

TEST(NoiseDetector, MeasuresWhiteNoiseUnderASlowForce) {
    for (const double size : {1e-5, 0.02, 3.0}) {
        const auto rest = force_samples(4000, [&](double k) { return size * white(k); });
        EXPECT_NEAR(noise_of(rest), size, 0.25 * size);
        for (const std::size_t block : {1, 17, 1000}) EXPECT_EQ(noise_of(rest, block), noise_of(rest));
        const auto press =
            force_samples(4000, [&](double k) { return size * white(k) + (k > 3000 ? 1000 * size * std::sin(0.001 * k) : 0); });
        EXPECT_NEAR(noise_of(press), size, 0.25 * size);
    }
}

TEST(NoiseDetector, FindsNoneInForcesThatAreOnlySlowOrVibrateOrAreConstant) {
    EXPECT_EQ(noise_of(force_samples(1000, [](double) { return 3.0; })), 0);
    EXPECT_EQ(noise_of(force_samples(1000, [](double k) { return 0.01 * k; })), 0);
    for (const double cycles : {0.01, 0.05, 0.1, 0.2, 0.24})  // a sample
        EXPECT_EQ(noise_of(force_samples(1000, [&](double k) { return std::sin(2 * std::numbers::pi * cycles * k); })), 0) << cycles;
    EXPECT_EQ(noise_of(force_samples(60, white)), 0) << "too short to tell";
    EXPECT_EQ(noise_of({}), 0);
}

}  // namespace
}  // namespace corpuscle
