#include "io/quality/fault_detectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// A grip force (N) of 0.8 Hz, with a 50 Hz hum and white noise of these amplitudes (N).
std::vector<double> grip(int n, double rate, double hum, double noise) {
    std::vector<double> x;
    for (int k = 0; k < n; ++k)
        x.push_back(2 + 1.5 * std::sin(two_pi * 0.8 * k / rate) + hum * std::sin(two_pi * 50 * k / rate + 1) +
                    noise * normal(1, 0, 0, static_cast<std::uint64_t>(k)));
    return x;
}

TEST(OutlierDetector, CountsIsolatedSamples) {
    auto x = grip(10'000, 250, 0.1, 0.02);
    OutlierDetector clean, with_outliers;
    clean.add(x);
    EXPECT_EQ(clean.count(), 0);
    std::int64_t outlier_count = 0;
    for (std::size_t k = 10; k + 10 < x.size(); k += 37) x[k] = k % 2 ? -40.0 : 4e3, ++outlier_count;
    with_outliers.add(x);
    EXPECT_NEAR(static_cast<double>(with_outliers.count()), static_cast<double>(outlier_count), 1);
    EXPECT_NEAR(static_cast<double>(with_outliers.examined()), 10'000, 6 * 3);
}

TEST(OutlierDetector, DoesNotDependOnTheBlocks) {
    auto x = grip(9'000, 250, 0.1, 0.3);
    for (std::size_t k = 5; k < x.size(); k += 41) x[k] = 40;
    OutlierDetector undivided, chunked;
    undivided.add(x);
    for (std::size_t k = 0, n = 1; k < x.size(); k += n, n = n % 1000 + 77) chunked.add(std::span(x).subspan(k, std::min(n, x.size() - k)));
    EXPECT_EQ(undivided.count(), chunked.count());
    EXPECT_EQ(undivided.examined(), chunked.examined());
    EXPECT_GT(undivided.count(), 100);
}

TEST(OutlierDetector, IgnoresChangesOfTheLastDigit) {
    std::vector<double> x;
    for (std::uint64_t k = 0; k < 5'000; ++k) x.push_back(512 + std::round(0.4 * normal(2, 0, 0, k)));
    OutlierDetector detector;
    detector.add(x);
    EXPECT_EQ(detector.count(), 0);
}

TEST(OutlierDetector, AgreesWithTheDefinition) {
    EXPECT_TRUE(rc::check("compared with medians by sorting and exact distances", [] {
        const auto x = *rc::gen::container<std::vector<double>>(400, rc::gen::map(rc::gen::inRange(-4096, 4096), [](int v) {
                                                                    // multiples of 32 and small numbers
                                                                    return v % 16 == 0 ? v * 32.0 : v % 16 * 1.0;
                                                                }));
        std::vector<double> distance, isolation, sorted;
        double smallest = 0;
        for (std::size_t k = 3; k + 3 < x.size(); ++k) {
            sorted.assign(x.begin() + static_cast<std::ptrdiff_t>(k) - 3, x.begin() + static_cast<std::ptrdiff_t>(k) + 4);
            std::sort(sorted.begin(), sorted.end());
            const double left = x[k] - x[k - 1], right = x[k] - x[k + 1];
            distance.push_back(std::abs(x[k] - sorted[3]));
            isolation.push_back(left * right > 0 ? std::min({distance.back(), std::abs(left), std::abs(right)}) : 0);
            if (isolation.back() > 0) smallest = smallest == 0 ? isolation.back() : std::min(smallest, isolation.back());
        }
        OutlierDetector detector;
        detector.add(x);
        // The detector's histogram has bins of a ratio of 1.25, so its limit may differ from the exact one by this factor.
        std::sort(distance.begin(), distance.end());
        const double median = distance[(distance.size() - 1) / 2];
        const auto above = [&](double limit) {
            return std::count_if(isolation.begin(), isolation.end(), [&](double a) { return a > limit; });
        };
        sorted = x;
        std::sort(sorted.begin(), sorted.end());
        const double spread = sorted.back() - sorted.front();
        RC_ASSERT(detector.count() <= above(std::max(8 * median / 1.25, 4 * smallest)));
        RC_ASSERT(detector.count() >= above(1.25 * std::max({8 * median, spread / 10, 4 * smallest})));
    }));
}

TEST(SaturationDetector, RequiresThreeVisitsToTheHighestValue) {
    SaturationDetector once, often;
    std::vector<double> x(100, 1.0);
    std::fill(x.begin() + 40, x.begin() + 60, 5.0);
    once.add(x);
    EXPECT_FALSE(once.is_likely());
    EXPECT_EQ(once.highest(), 5);
    for (int visit = 0; visit < 3; ++visit) often.add(x);
    EXPECT_TRUE(often.is_likely());
    EXPECT_NEAR(often.fraction(), 0.2, 1e-12);
}

TEST(HumDetector, MeasuresTheFractionOfASpectralLine) {
    for (const double rate : {242.6, 1000.0, 10e3}) {
        const auto clock = test::value_or_throw(make_clock(rate));
        const HumTable table(clock);
        HumDetector with(table), without(table), noisy(table);
        const int n = static_cast<int>(20 * rate);
        with.add(grip(n, rate, 0.2, 0.01));
        without.add(grip(n, rate, 0, 0.01));
        noisy.add(grip(n, rate, 0, 1));
        // The variance within a second is most of 1.5^2 / 2 (the slow sine) plus 0.2^2 / 2 (the hum).
        const double fraction = 0.02 / (1.125 + 0.02);
        EXPECT_EQ(with.result().frequency, 50);
        EXPECT_GT(with.result().fraction, 0.7 * fraction) << rate;
        EXPECT_LT(with.result().fraction, 2 * fraction) << rate;
        EXPECT_EQ(without.result().fraction, 0) << rate;
        EXPECT_EQ(noisy.result().fraction, 0) << rate;
    }
}

TEST(HumDetector, IgnoresFrequenciesAboveNyquist) {
    const auto clock = test::value_or_throw(make_clock(100));
    const HumTable table(clock);
    HumDetector detector(table);
    detector.add(grip(2000, 100, 1, 0));
    EXPECT_EQ(detector.result().frequency, 0);
}

TEST(SumDetector, ACopyOfAChannelBesideSilentOnesIsNotATotal) {
    SumDetector detector;
    detector.add({{0, 0, 0}, {1, 2, 3}, {1, 2, 3}, {0, 0, 0}, {0, 0, 0}});
    EXPECT_TRUE(detector.find_sums().empty());
}

TEST(SumDetector, FindsTotals) {
    std::vector<std::vector<double>> block(5);
    for (int k = 0; k < 50; ++k) {
        const double a = std::round(100 * std::sin(k)), b = k % 7, c = 3 + k % 5;
        for (auto [n, v] : {std::pair{0, a}, {1, b}, {2, c}, {3, b + c}, {4, 9.0}}) block[static_cast<std::size_t>(n)].push_back(v);
    }
    SumDetector detector;
    detector.add(block);
    const auto found = detector.find_sums();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].channel, 3U);
    EXPECT_EQ(found[0].from, 1U);
    EXPECT_EQ(found[0].to, 2U);
}

}  // namespace
}  // namespace corpuscle
