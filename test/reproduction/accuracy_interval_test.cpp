// The interval of an accuracy.

#include "reproduction/readout/accuracy_interval.hpp"

#include <gtest/gtest.h>

namespace corpuscle {
namespace {

std::vector<std::size_t> groups_of(std::size_t trials, std::size_t size) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < trials; ++k) out.push_back(k / size);
    return out;
}

TEST(AccuracyInterval, OfIndependentTrialsIsWilsons) {
    // 8 of 10; each group has the same part of correct trials, so that there is no spread between them.
    const auto a = accuracy_interval({1, 1, 1, 1, 0, 1, 1, 1, 1, 0}, groups_of(10, 5));
    EXPECT_DOUBLE_EQ(a.mean, 0.8);
    // (p + z^2/2n -+ z sqrt(p(1-p)/n + z^2/4n^2)) / (1 + z^2/n) with z = 1.96
    EXPECT_NEAR(a.low, 0.4902, 1e-4);
    EXPECT_NEAR(a.high, 0.9433, 1e-4);
}

TEST(AccuracyInterval, OfGroupsThatAreRightOrWrongTogetherIsThatOfAsManyTrialsAsGroups) {
    // The spread between n groups is estimated with n - 1, so the interval is that of 9 trials instead of 10.
    std::vector<double> together, independent;
    for (std::size_t k = 0; k < 100; ++k) together.push_back(k < 80);
    for (std::size_t k = 0; k < 9; ++k) independent.push_back(0.8);
    const auto a = accuracy_interval(together, groups_of(100, 10)), b = accuracy_interval(independent, groups_of(9, 1));
    EXPECT_DOUBLE_EQ(a.mean, 0.8);
    EXPECT_NEAR(a.low, b.low, 1e-12);
    EXPECT_NEAR(a.high, b.high, 1e-12);
}

TEST(AccuracyInterval, OfCertaintyCountsEachGroupAsOneTrial) {
    const auto four = accuracy_interval(std::vector<double>(28, 1), groups_of(28, 7));
    EXPECT_DOUBLE_EQ(four.mean, 1);
    EXPECT_DOUBLE_EQ(four.high, 1);
    EXPECT_NEAR(four.low, 4 / (4 + 1.959964 * 1.959964), 1e-12);
    EXPECT_NEAR(accuracy_interval(std::vector<double>(28, 0), groups_of(28, 7)).high, 1 - four.low, 1e-12);
}

}  // namespace
}  // namespace corpuscle
