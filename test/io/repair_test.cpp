#include "io/quality/filters.hpp"

#include <algorithm>
#include <cmath>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

std::vector<double> filled(const std::vector<double>& x, std::size_t block) {
    GapFiller gaps;
    std::vector<double> out;
    for (std::size_t k = 0; k < x.size(); k += block)
        EXPECT_TRUE(static_cast<bool>(gaps.push(std::span(x).subspan(k, std::min(block, x.size() - k)), out)));
    EXPECT_TRUE(static_cast<bool>(gaps.finish(out)));
    return out;
}

std::vector<double> without_outliers(const std::vector<double>& x, const DespikeOptions& despike) {
    HampelFilter filter(despike);
    std::vector<double> out;
    for (const double v : x) filter.push(v, out);
    filter.finish(out);
    return out;
}

TEST(GapFiller, InterpolatesLinearlyAndHoldsTheEnds) {
    const std::vector<double> x = {gap, gap, 1, 2, gap, gap, 5, gap}, expected = {1, 1, 1, 2, 3, 4, 5, 5};
    for (const std::size_t block : {1, 2, 3, 8}) EXPECT_EQ(filled(x, block), expected);
}

TEST(GapFiller, ReportsThatThereIsNoGoodSample) {
    GapFiller gaps;
    std::vector<double> out;
    const double x[] = {gap, gap};
    ASSERT_TRUE(static_cast<bool>(gaps.push(x, out)));
    EXPECT_EQ(gaps.finish(out).error().message, "all samples are missing or bad");
}

TEST(HampelFilter, RemovesOutliersAndNothingElse) {
    std::vector<double> x;
    for (int k = 0; k < 200; ++k) x.push_back(100 * std::sin(0.05 * k));
    auto with_outliers = x;
    for (const std::size_t k : {0U, 3U, 50U, 51U, 120U, 199U}) with_outliers[k] = 1e6;
    const auto filtered = without_outliers(with_outliers, {.limit = 300});
    ASSERT_EQ(filtered.size(), x.size());
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_TRUE(with_outliers[k] == x[k] ? filtered[k] == x[k] : std::isnan(filtered[k])) << k;
    EXPECT_EQ(without_outliers(x, {.limit = 300}), x);
}

TEST(HampelFilter, AgreesWithTheMedianOfEachWindow) {
    EXPECT_TRUE(rc::check("compared with Hampel's rule, with gaps", [] {
        auto x = *rc::gen::container<std::vector<double>>(rc::gen::map(rc::gen::inRange(-50, 50), [](int v) { return v == 7 ? gap : v; }));
        const double limit = *rc::gen::inRange(1, 40);
        const auto filtered = without_outliers(x, {.limit = limit});
        RC_ASSERT(filtered.size() == x.size());
        const auto n = static_cast<std::ptrdiff_t>(x.size());
        for (std::ptrdiff_t k = 0; k < n; ++k) {
            // The window has 25 samples, 12 of them after k. Near the end it is the last 25, near the start it has fewer.
            const std::ptrdiff_t last = std::min(n - 1, k + 12), first = std::max<std::ptrdiff_t>(0, last - 24);
            std::vector<double> window;
            for (auto j = first; j <= last; ++j)
                if (!std::isnan(x[static_cast<std::size_t>(j)])) window.push_back(x[static_cast<std::size_t>(j)]);
            std::sort(window.begin(), window.end());
            const double reading = x[static_cast<std::size_t>(k)], out = filtered[static_cast<std::size_t>(k)];
            const bool is_outlier = !std::isnan(reading) && std::abs(reading - window[window.size() / 2]) > limit;
            RC_ASSERT((std::isnan(reading) || is_outlier ? std::isnan(out) : out == reading));
        }
    }));
}

}  // namespace
}  // namespace corpuscle
