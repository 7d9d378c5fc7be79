#include "reproduction/claims/study_curve.hpp"

#include <cmath>

#include "support/property.hpp"

namespace corpuscle {
namespace {

const StudyCurve parabola{{0, 1, 3, 4, 7}, {0, 1, 9, 16, 49}};

TEST(StudyCurve, IsInterpolatedBetweenItsPointsAndNowhereElse) {
    EXPECT_EQ(parabola.at(3), 9);
    EXPECT_EQ(parabola.at(2), 5);
    EXPECT_TRUE(std::isnan(parabola.at(-0.1)));
    EXPECT_TRUE(std::isnan(parabola.at(7.1)));
    EXPECT_TRUE(std::isnan(StudyCurve().at(0)));
}

TEST(StudyCurve, FindsWhereItCrossesALevel) {
    const StudyCurve saw{{0, 1, 2, 3}, {0, 2, 0, 2}};
    EXPECT_EQ(saw.crossing(1), 0.5);
    EXPECT_EQ(saw.crossing(1, 0.6), 1.5);
    EXPECT_EQ(saw.crossing(2), 1);
    EXPECT_TRUE(std::isnan(saw.crossing(3)));
    EXPECT_TRUE(std::isnan(StudyCurve().crossing(0)));
}

TEST(StudyCurve, HasTheExactSlopeOfAParabolaAtUnevenPoints) {
    const auto slope = parabola.slope();
    ASSERT_EQ(slope.x, (std::vector<double>{1, 3, 4}));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(slope.y[k], 2 * slope.x[k], 1e-12);
    EXPECT_TRUE(StudyCurve({{0, 1}, {0, 1}}).slope().empty());
}

TEST(StudyCurve, FitsAStraightLine) {
    const auto exact = StudyCurve{{1, 2, 5}, {5, 7, 13}}.fit_line();
    EXPECT_NEAR(exact.intercept, 3, 1e-12);
    EXPECT_NEAR(exact.slope, 2, 1e-12);
    EXPECT_NEAR(exact.max_deviation, 0, 1e-12);
    EXPECT_NEAR((StudyCurve{{0, 1, 2, 3}, {0, 1, 1, 0}}.fit_line().max_deviation), 0.5, 1e-12);
}

TEST(StudyCurve, GivesItsExtremes) {
    const StudyCurve hill{{0, 1, 2}, {-3, 5, 1}};
    EXPECT_EQ(hill.min(), -3);
    EXPECT_EQ(hill.max(), 5);
    EXPECT_EQ(hill.x_of_max(), 1);
    EXPECT_EQ(hill.absolute().y, (std::vector<double>{3, 5, 1}));
    EXPECT_EQ(hill.between(0.5, 2).x, (std::vector<double>{1, 2}));
    EXPECT_EQ(hill.scaled(2, -1).y, (std::vector<double>{3, -5, -1}));
    EXPECT_TRUE(std::isnan(StudyCurve().max()) && std::isnan(StudyCurve().min()) && std::isnan(StudyCurve().x_of_max()));
}

RC_GTEST_PROP(StudyCurve, HasTheLevelWhereItCrossesIt, (const std::vector<int>& steps)) {
    StudyCurve line;
    for (const int s : steps) line.x.push_back(static_cast<double>(line.x.size())), line.y.push_back(s % 100);
    RC_PRE(!line.empty());
    const double level = 0.5 * (line.min() + line.max());
    const double where = line.crossing(level);
    RC_ASSERT(std::abs(line.at(where) - level) < 1e-9);
}

}  // namespace
}  // namespace corpuscle
