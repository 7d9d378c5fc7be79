#include "io/quality/filters.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "support/support.hpp"

namespace corpuscle {
namespace {

constexpr double tau = 2 * std::numbers::pi;

/// Amplitude of the filter's output for a sine of amplitude 1 and frequency f, after it has settled.
double gain_at(Biquad filter, double f, double rate) {
    std::complex<double> sum = 0;
    const int settle = static_cast<int>(4 * rate), n = static_cast<int>(10 * rate);  // whole periods of integer frequencies
    for (int k = 0; k < settle + n; ++k) {
        const double y = filter.next(std::sin(tau * f * k / rate));
        if (k >= settle) sum += y * std::polar(1.0, -tau * f * k / rate);
    }
    return 2 * std::abs(sum) / n;
}

TEST(Biquad, NotchRemovesItsFrequencyAndAttenuatesByThreeDecibelsTwoHertzAway) {
    const auto clock = test::value_or_throw(make_clock(1000));
    const auto notch = test::value_or_throw(Biquad::notch(50, clock));
    EXPECT_LT(gain_at(notch, 50, 1000), 1e-6);
    for (const double f : {48.0, 52.0}) EXPECT_NEAR(gain_at(notch, f, 1000), std::sqrt(0.5), 0.02);
    for (const double f : {1.0, 20.0, 200.0, 400.0}) EXPECT_NEAR(gain_at(notch, f, 1000), 1, 0.01);
}

TEST(Biquad, LowpassIsButterworthOfSecondOrder) {
    const double rate = 1000, corner = 30;
    const auto clock = test::value_or_throw(make_clock(rate));
    const auto filter = test::value_or_throw(Biquad::lowpass(corner, clock));
    for (const double f : {3.0, 30.0, 100.0, 300.0}) {  // `ratio`: f over the corner, both warped by the bilinear transform
        const double ratio = std::tan(tau / 2 * f / rate) / std::tan(tau / 2 * corner / rate);
        EXPECT_NEAR(gain_at(filter, f, rate), 1 / std::sqrt(1 + std::pow(ratio, 4)), 1e-6);
    }
}

TEST(Biquad, StartsInSteadyStateAndKeepsAConstant) {
    const auto clock = test::value_or_throw(make_clock(242.6));
    for (auto filter : {test::value_or_throw(Biquad::notch(50, clock)), test::value_or_throw(Biquad::lowpass(20, clock))})
        for (int k = 0; k < 1000; ++k) EXPECT_NEAR(filter.next(3.5), 3.5, 1e-12);
}

TEST(Biquad, RefusesZeroAndTheNyquistFrequency) {
    const auto clock = test::value_or_throw(make_clock(100));
    EXPECT_EQ(Biquad::notch(50, clock).error().message, "--notch 50Hz: at a sample rate of 100 Hz it must be between 0 and 50 Hz");
    EXPECT_FALSE(Biquad::lowpass(0, clock));
    EXPECT_TRUE(static_cast<bool>(Biquad::notch(49, clock)));
}

}  // namespace
}  // namespace corpuscle
