#include <cmath>
#include <random>

#include "core/number/elementary.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

double ulps(double actual, long double expected) {
    const double r = static_cast<double>(expected);
    const double ulp = std::nextafter(std::abs(r), INFINITY) - std::abs(r);
    return static_cast<double>(std::abs(static_cast<long double>(actual) - expected)) / ulp;
}

TEST(Elementary, ExpIsWithinTwoUnitsInTheLastPlace) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> x(-700, 700), small(-1, 1);
    for (int k = 0; k < 100000; ++k)
        for (const double a : {x(random), small(random)}) ASSERT_LT(ulps(num::exp(a), std::exp(static_cast<long double>(a))), 2) << a;
    EXPECT_EQ(num::exp(0.0), 1.0);
}

TEST(Elementary, LogIsWithinTwoUnitsInTheLastPlace) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> e(-700, 700), near_one(0.5, 2);
    for (int k = 0; k < 100000; ++k)
        for (const double a : {std::exp(e(random)), near_one(random)})
            ASSERT_LT(std::abs(static_cast<long double>(num::log(a)) - std::log(static_cast<long double>(a))),
                      3e-16L * std::max(1.0L, std::abs(std::log(static_cast<long double>(a)))))
                << a;
    EXPECT_EQ(num::log(1.0), 0.0);
}

TEST(Elementary, SineAndCosineOfTurnsAreExactAtQuartersAndCloseElsewhere) {
    for (int q = -8; q <= 8; ++q) {
        EXPECT_EQ(num::sin_turns(0.25 * q), (q % 4 == 0 || q % 2 == 0) ? 0.0 : (((q % 4) + 4) % 4 == 1 ? 1.0 : -1.0)) << q;
        EXPECT_EQ(num::cos_turns(0.25 * q), q % 2 != 0 ? 0.0 : (q % 4 == 0 ? 1.0 : -1.0)) << q;
    }
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> x(-1000, 1000);
    const long double turn = 2 * std::acos(-1.0L);
    for (int k = 0; k < 100000; ++k) {
        const double a = x(random);
        ASSERT_LT(std::abs(num::sin_turns(a) - std::sin(turn * std::remainder(static_cast<long double>(a), 1.0L))), 4e-16L) << a;
        ASSERT_LT(std::abs(num::cos_turns(a) - std::cos(turn * std::remainder(static_cast<long double>(a), 1.0L))), 4e-16L) << a;
    }
}

TEST(Elementary, ExprelIsAccurateNearZero) {
    for (double x = -1; x < 1; x += 1e-4)
        ASSERT_NEAR(num::exprel(x), x == 0 ? 1.0 : static_cast<double>(std::expm1(static_cast<long double>(x)) / x), 1e-13) << x;
    for (double x = 1e-300; x < 1; x *= 7)
        ASSERT_NEAR(num::exprel(-x), static_cast<double>(-std::expm1(-static_cast<long double>(x)) / x), 1e-13) << x;
    EXPECT_EQ(num::exprel(0.0), 1.0);
}

TEST(Elementary, SlopesOfDualsMatchFiniteDifferences) {
    using num::Dual;
    const auto check = [](auto f, double x) {
        const double h = 1e-6 * std::max(1.0, std::abs(x));
        const double slope = (f(Dual{x + h}).v - f(Dual{x - h}).v) / (2 * h);
        EXPECT_NEAR(f(Dual{x, 1}).d, slope, 1e-7 * std::max(1.0, std::abs(slope))) << x;
    };
    for (const double x : {0.3, 1.7, 4.9}) {
        check([](Dual a) { return num::exp(a); }, x);
        check([](Dual a) { return num::log(a); }, x);
        check([](Dual a) { return num::sqrt(a); }, x);
        check([](Dual a) { return num::sin_turns(a); }, x);
        check([](Dual a) { return num::cos_turns(a); }, x);
        check([](Dual a) { return num::exprel(a); }, x);
        check([](Dual a) { return (a * a - Dual{2} / a + -a) / (a + Dual{1}); }, x);
        check([](Dual a) { return num::max(a, Dual{2}) + num::min(a, Dual{2}) * num::positive_part(a - Dual{1}) + num::abs(-a); }, x);
    }
}

}  // namespace
}  // namespace corpuscle
