#include "study/line.hpp"

#include <cmath>

#include "support/property.hpp"

namespace corpuscle {
namespace {

const Line parabola{{0, 1, 3, 4, 7}, {0, 1, 9, 16, 49}};

TEST(Line, IsReadBetweenItsPairsAndNowhereElse) {
    EXPECT_EQ(parabola.at(3), 9);
    EXPECT_EQ(parabola.at(2), 5);
    EXPECT_TRUE(std::isnan(parabola.at(-0.1)));
    EXPECT_TRUE(std::isnan(parabola.at(7.1)));
    EXPECT_TRUE(std::isnan(Line().at(0)));
}

TEST(Line, FindsWhereItPassesALevel) {
    const Line saw{{0, 1, 2, 3}, {0, 2, 0, 2}};
    EXPECT_EQ(saw.where(1), 0.5);
    EXPECT_EQ(saw.where(1, 0.6), 1.5);
    EXPECT_EQ(saw.where(2), 1);
    EXPECT_TRUE(std::isnan(saw.where(3)));
    EXPECT_TRUE(std::isnan(Line().where(0)));
}

TEST(Line, HasTheExactSlopeOfAParabolaAtUnevenPairs) {
    const auto slope = parabola.slope();
    ASSERT_EQ(slope.x, (std::vector<double>{1, 3, 4}));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(slope.y[k], 2 * slope.x[k], 1e-12);
    EXPECT_TRUE(Line({{0, 1}, {0, 1}}).slope().empty());
}

TEST(Line, ComesNearestToAStraightOne) {
    const auto exact = Line{{1, 2, 5}, {5, 7, 13}}.straight();
    EXPECT_NEAR(exact.at_zero, 3, 1e-12);
    EXPECT_NEAR(exact.slope, 2, 1e-12);
    EXPECT_NEAR(exact.farthest, 0, 1e-12);
    EXPECT_NEAR((Line{{0, 1, 2, 3}, {0, 1, 1, 0}}.straight().farthest), 0.5, 1e-12);
}

TEST(Line, GivesItsExtremes) {
    const Line hill{{0, 1, 2}, {-3, 5, 1}};
    EXPECT_EQ(hill.least(), -3);
    EXPECT_EQ(hill.most(), 5);
    EXPECT_EQ(hill.peak(), 1);
    EXPECT_EQ(hill.absolute().y, (std::vector<double>{3, 5, 1}));
    EXPECT_EQ(hill.between(0.5, 2).x, (std::vector<double>{1, 2}));
    EXPECT_EQ(hill.times(2, -1).y, (std::vector<double>{3, -5, -1}));
    EXPECT_TRUE(std::isnan(Line().most()) && std::isnan(Line().least()) && std::isnan(Line().peak()));
}

RC_GTEST_PROP(Line, PassesALevelWhereItIsReadAsThatLevel, (const std::vector<int>& steps)) {
    Line line;
    for (const int s : steps) line.x.push_back(static_cast<double>(line.x.size())), line.y.push_back(s % 100);
    RC_PRE(!line.empty());
    const double level = 0.5 * (line.least() + line.most());
    const double where = line.where(level);
    RC_ASSERT(std::abs(line.at(where) - level) < 1e-9);
}

}  // namespace
}  // namespace corpuscle
