// Confidence intervals, compared with numbers of SciPy 1.10 (with the call that returned them) and with their definition.

#include "sweep/stats/estimate.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "core/random.hpp"
#include "sweep/spec/probability.hpp"

namespace corpuscle {
namespace {

TEST(Probability, DistributionsEqualThoseOfScipy) {
    const struct {
        double ours, theirs;
    } rows[] = {{normal_quantile(0.975), 1.959963984540054},             // stats.norm.ppf(.975)
                {normal_quantile(1e-10), -6.361340902404056},            // stats.norm.ppf(1e-10)
                {incomplete_beta(2.5, 0.5, 0.3), 0.01892712407194565},   // special.betainc(2.5, .5, .3)
                {incomplete_beta(500, 501, 0.5), 0.5126125090888417},    // special.betainc(500, 501, .5)
                {incomplete_beta(1e5, 1e5, 0.501), 0.8144532553270518},  // special.betainc(1e5, 1e5, .501)
                {beta_quantile(8, 3, 0.025), 0.44390453769235844},       // special.betaincinv(8, 3, .025)
                {beta_quantile(0.5, 20, 1e-6), 3.976381106974146e-14},   // special.betaincinv(.5, 20, 1e-6)
                {student_quantile(1, 0.975), 12.706204736432095},        // stats.t.ppf(.975, 1)
                {student_quantile(9, 0.975), 2.2621571627409915},        // stats.t.ppf(.975, 9)
                {student_quantile(999, 0.001), -3.098410361753265},      // stats.t.ppf(.001, 999)
                {student_two_sided(20, 3.1), 0.0056448769391241865},     // 2 * stats.t.sf(3.1, 20)
                {student_two_sided(998, 8), 3.4333447106990414e-15},     // 2 * stats.t.sf(8, 998)
                {fisher_upper(3, 40, 4.2), 0.011270563257885424},        // stats.f.sf(4.2, 3, 40)
                {binomial_up_to(3, 10, 0.4), 0.3822806016},              // stats.binom.cdf(3, 10, .4)
                {binomial_up_to(480, 1000, 0.5), 0.10872414660207046}};  // stats.binom.cdf(480, 1000, .5)
    for (const auto& r : rows) EXPECT_NEAR(r.ours / r.theirs, 1, 1e-9) << r.theirs;
    EXPECT_NEAR(normal_quantile(0.5), 0, 1e-15);
    EXPECT_EQ(normal_quantile(1), HUGE_VAL);
}

TEST(Estimate, AYieldHasTheIntervalOfClopperAndPearson) {
    const struct {
        std::int64_t passed, items;
        double low, high;
    } rows[] = {{0, 20, 0, 0.16843347098308548},  // stats.binomtest(k, n).proportion_ci(method='exact')
                {20, 20, 0.8315665290169145, 1},
                {7, 10, 0.3475471499399921, 0.9332604888222655},
                {874, 1000, 0.8518262835291261, 0.893943167737706},
                {999000, 1000000, 0.9989360818926863, 0.9990609987920546}};
    for (const auto& r : rows) {
        const auto fraction = estimate_proportion(r.passed, r.items);
        EXPECT_DOUBLE_EQ(fraction.value, static_cast<double>(r.passed) / static_cast<double>(r.items));
        EXPECT_NEAR(fraction.low, r.low, 1e-12);
        EXPECT_NEAR(fraction.high, r.high, 1e-12);
    }
    EXPECT_TRUE(std::isnan(estimate_proportion(0, 0).value));
}

const std::vector<double> ten = {3.1, 2.4, 5.6, 4.4, 9.9, std::nan(""), 3.3, 2.8, 4.1, 6.5, 3.9};

TEST(Estimate, ASampleOfTenHasTheMeanDeviationAndQuantilesOfScipyAndNumpy) {
    const SortedSample sample(ten);
    ASSERT_EQ(sample.count(), 10U);
    EXPECT_NEAR(sample.mean().value, 4.6, 1e-12);
    EXPECT_NEAR(sample.mean().low, 2.9915512862913634, 1e-9);  // stats.t.interval(.95, 9, mean, stats.sem(x))
    EXPECT_NEAR(sample.mean().high, 6.208448713708636, 1e-9);
    EXPECT_NEAR(sample.sigma().value, 2.2484562605386738, 1e-12);
    EXPECT_NEAR(sample.sigma().low, 0.99777219, 1e-7);  // Bonett's formula with stats.trim_mean, computed in numpy
    EXPECT_NEAR(sample.sigma().high, 6.30201597, 1e-7);
    EXPECT_NEAR(sample.quantile(0.05).value, 2.58, 1e-12);  // np.quantile
    EXPECT_NEAR(sample.quantile(0.9).value, 6.84, 1e-12);
    EXPECT_NEAR(sample.normality(), 0.9132787689190912, 1e-12);  // np.corrcoef(sorted, stats.norm.ppf((i - .375) / (n + .25)))
    EXPECT_GT(sample.normality_floor(), 0.91);
    EXPECT_LT(sample.normality_floor(), 0.92);  // Looney and Gulledge: 0.918
}

TEST(Estimate, TheIntervalOfAQuantileFollowsFromTheBinomialDistribution) {
    const struct {
        int n;
        double q;
        int low, high;  // the largest k with stats.binom.cdf(k - 1, n, q) <= .025, the smallest with stats.binom.sf(k - 1, n, q) <= .025
    } rows[] = {{100, 0.5, 40, 61}, {100, 0.05, 1, 11}, {100, 0.95, 90, 100}, {10, 0.5, 2, 9}, {5, 0.5, 0, 0}, {1000, 0.25, 223, 278}};
    for (const auto& r : rows) {
        std::vector<double> values;
        for (int k = r.n; k >= 1; --k) values.push_back(k);
        const auto found = SortedSample(values).quantile(r.q);
        if (r.low == 0) {
            EXPECT_TRUE(std::isnan(found.low) && std::isnan(found.high)) << r.n;
        } else {
            EXPECT_EQ(found.low, r.low) << r.n << ' ' << r.q;
            EXPECT_EQ(found.high, r.high) << r.n << ' ' << r.q;
        }
    }
}

TEST(Estimate, OfNoValueOrOneValueIsNaNOnlyWhereUndefined) {
    const SortedSample none(std::vector<double>{}), one({3}), same({2, 2, 2, 2, 2, 2});
    EXPECT_TRUE(std::isnan(none.mean().value) && std::isnan(none.sigma().value) && std::isnan(none.quantile(0.5).value));
    EXPECT_EQ(one.mean().value, 3);
    EXPECT_TRUE(std::isnan(one.mean().low) && std::isnan(one.sigma().value));
    EXPECT_EQ(one.quantile(0.5).value, 3);
    EXPECT_EQ(same.sigma().value, 0);
    EXPECT_TRUE(std::isnan(same.normality()));
}

/// The fraction of 2000 samples of size n for which the interval of the deviation contains the true value.
template <class Sampler>
double coverage(int n, double truth, Sampler&& sampler) {
    int inside = 0;
    for (std::uint32_t sample = 0; sample < 2000; ++sample) {
        std::vector<double> values;
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(n); ++k) values.push_back(sampler(normal_pair(11, sample, 1, k)));
        const auto sigma = SortedSample(std::move(values)).sigma();
        inside += sigma.low <= truth && truth <= sigma.high;
    }
    return inside / 2000.0;
}

TEST(Estimate, TheIntervalOfSigmaHasItsCoverageForOtherDistributionsToo) {
    EXPECT_NEAR(coverage(50, 1, [](NormalPair x) { return x.first; }), 0.95, 0.02);
    EXPECT_NEAR(coverage(50, 1 / std::sqrt(12.0), [](NormalPair x) { return 0.5 * std::erfc(x.first / std::sqrt(2.0)); }), 0.95,
                0.03);  // uniform
    // Exponential: the interval from chi-squared would contain it in 7 of 10.
    EXPECT_NEAR(coverage(200, 2, [](NormalPair x) { return x.first * x.first + x.second * x.second; }), 0.95, 0.04);
}

TEST(Estimate, ANormalPlotDistinguishesNormalSamplesFromOthers) {
    for (const int n : {20, 1000, 5000}) {
        int normal = 0, others = 0;
        for (std::uint32_t sample = 0; sample < 60; ++sample) {
            std::vector<double> x, y;
            for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(n); ++k) {
                const auto deviates = normal_pair(12, sample, 1, k);
                x.push_back(deviates.first), y.push_back(deviates.first * deviates.first + deviates.second * deviates.second);
            }
            const SortedSample a(std::move(x)), b(std::move(y));
            normal += a.normality() >= a.normality_floor(), others += b.normality() >= b.normality_floor();
        }
        EXPECT_GE(normal, 51) << n;  // 57 of 60 are expected; fewer than 51 occur once in 200 times
        EXPECT_LE(others, n == 20 ? 30 : 0) << n;
    }
}

}  // namespace
}  // namespace corpuscle
