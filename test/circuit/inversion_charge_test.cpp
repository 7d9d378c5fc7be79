// The inversion charge of a channel, compared with arithmetic of more than 50 digits (MPFR, 200 bits).

#include "circuit/device/inversion_charge.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::circuit {
namespace {

/// Solution q of q + ln q = x to 200 bits.
class Exact {
    mpfr_t q_, r_, p_;

public:
    Exact() { mpfr_inits2(200, q_, r_, p_, nullptr); }
    ~Exact() { mpfr_clears(q_, r_, p_, nullptr); }
    Exact(const Exact&) = delete;
    Exact& operator=(const Exact&) = delete;

    /// Relative error of `found` as the solution for x.
    double error(double x, double found) {
        mpfr_set_d(q_, found, MPFR_RNDN);
        for (int step = 0; step < 6; ++step) {  // Newton in ln q: q <- q (1 + (x - q - ln q) / (1 + q))
            mpfr_log(r_, q_, MPFR_RNDN), mpfr_add(r_, r_, q_, MPFR_RNDN), mpfr_d_sub(r_, x, r_, MPFR_RNDN);
            mpfr_add_ui(p_, q_, 1, MPFR_RNDN), mpfr_div(r_, r_, p_, MPFR_RNDN);
            mpfr_add_ui(r_, r_, 1, MPFR_RNDN), mpfr_mul(q_, q_, r_, MPFR_RNDN);
        }
        mpfr_d_sub(r_, found, q_, MPFR_RNDN), mpfr_div(r_, r_, q_, MPFR_RNDN);
        return std::abs(mpfr_get_d(r_, MPFR_RNDN));
    }
};

TEST(Inversion, HasARelativeErrorBelowATenthOfATrillionth) {
    Exact exact;
    double worst = 0, worst_near = 0;
    for (int k = -28000; k <= 28000; ++k) {
        const double x = k * 0.025 + 0.00037 * (k % 7);
        if (std::abs(x) > 700) continue;
        const double e = exact.error(x, inversion_charge(x));
        worst = std::max(worst, e);
        if (std::abs(x) < 20) worst_near = std::max(worst_near, e);
        ASSERT_LT(e, 1e-13) << x;
    }
    EXPECT_LT(worst, 7e-14);
    EXPECT_LT(worst_near, 4e-15);
}

TEST(Inversion, IsAccurateWhereItsInitialGuessesChange) {
    Exact exact;
    for (const double joint : {-2.5, 6.0})
        for (double x = joint - 1e-9; x <= joint + 1e-9; x += 1e-11) ASSERT_LT(exact.error(x, inversion_charge(x)), 4e-15) << x;
}

TEST(Inversion, IsOneAtOne) { EXPECT_NEAR(inversion_charge(1.0), 1.0, 3e-16); }

TEST(Inversion, StaysFiniteAndRisesForExtremeArguments) {
    double before = 0;
    for (const double x : {-1e9, -1e4, -701.0, -699.0, -10.0, 0.0, 10.0, 701.0, 1e4, 1e9}) {
        const double q = inversion_charge(x);
        EXPECT_TRUE(std::isfinite(q)) << x;
        EXPECT_GE(q, before) << x;
        before = q;
    }
    EXPECT_TRUE(std::isnan(inversion_charge(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Inversion, SlopeOfADualMatchesFiniteDifferences) {
    for (double x = -30; x < 30; x += 0.37) {
        const double h = 1e-6, slope = (inversion_charge(x + h) - inversion_charge(x - h)) / (2 * h);
        EXPECT_NEAR(inversion_charge(num::Dual{x, 1}).d, slope, 1e-7 * std::max(slope, inversion_charge(x))) << x;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
