#include "io/repair.hpp"

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

std::vector<double> without_strays(const std::vector<double>& x, const DespikeOptions& despike) {
    HampelFilter filter(despike);
    std::vector<double> out;
    for (const double v : x) filter.push(v, out);
    filter.finish(out);
    return out;
}

TEST(GapFiller, DrawsStraightLinesAndHoldsTheEnds) {
    const std::vector<double> x = {gap, gap, 1, 2, gap, gap, 5, gap}, right = {1, 1, 1, 2, 3, 4, 5, 5};
    for (const std::size_t block : {1, 2, 3, 8}) EXPECT_EQ(filled(x, block), right);
}

TEST(GapFiller, SaysSoIfThereIsNoGoodReading) {
    GapFiller gaps;
    std::vector<double> out;
    const double x[] = {gap, gap};
    ASSERT_TRUE(static_cast<bool>(gaps.push(x, out)));
    EXPECT_EQ(gaps.finish(out).error().message, "all samples are missing or bad");
}

TEST(HampelFilter, TakesOutWhatStandsAloneAndNothingElse) {
    std::vector<double> x;
    for (int k = 0; k < 200; ++k) x.push_back(100 * std::sin(0.05 * k));
    auto torn = x;
    for (const std::size_t k : {0U, 3U, 50U, 51U, 120U, 199U}) torn[k] = 1e6;
    const auto judged = without_strays(torn, {.limit = 300});
    ASSERT_EQ(judged.size(), x.size());
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_TRUE(torn[k] == x[k] ? judged[k] == x[k] : std::isnan(judged[k])) << k;
    EXPECT_EQ(without_strays(x, {.limit = 300}), x);
}

TEST(HampelFilter, AgreesWithTheMedianOfTheWindowWorkedOutAnew) {
    EXPECT_TRUE(rc::check("Hampel's rule, gaps among the readings", [] {
        auto x = *rc::gen::container<std::vector<double>>(rc::gen::map(rc::gen::inRange(-50, 50), [](int v) { return v == 7 ? gap : v; }));
        const double limit = *rc::gen::inRange(1, 40);
        const auto judged = without_strays(x, {.limit = limit});
        RC_ASSERT(judged.size() == x.size());
        const auto n = static_cast<std::ptrdiff_t>(x.size());
        for (std::ptrdiff_t k = 0; k < n; ++k) {
            // at the end the window is the last 25, at the start what there is
            const std::ptrdiff_t last = std::min(n - 1, k + 12), first = std::max<std::ptrdiff_t>(0, last - 24);
            std::vector<double> window;
            for (auto j = first; j <= last; ++j)
                if (!std::isnan(x[static_cast<std::size_t>(j)])) window.push_back(x[static_cast<std::size_t>(j)]);
            std::sort(window.begin(), window.end());
            const double here = x[static_cast<std::size_t>(k)], out = judged[static_cast<std::size_t>(k)];
            const bool stray = !std::isnan(here) && std::abs(here - window[window.size() / 2]) > limit;
            RC_ASSERT((std::isnan(here) || stray ? std::isnan(out) : out == here));
        }
    }));
}

}  // namespace
}  // namespace corpuscle
