// The transistor compared with its published equations: the thesis's, ACM2's, Shockley's, Nyquist's.

#include <gtest/gtest.h>

#include <vector>

#include "circuit/device/uicm_card.hpp"
#include "circuit/uicm_cards.hpp"

namespace corpuscle::circuit {
namespace {

using namespace test;

TEST(Uicm, ThePlainModelHasTheThesissCurrentAndConductances) {  // eq. 21 to 30
    const auto c = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    for (double g = 0; g < 1.5; g += 0.07)
        for (double d = 0; d < 1; d += 0.11) {
            const auto out = evaluate(c, d, g, 0.05, 0);
            const double V_P = (g - 0.461) / 1.27, q_S = inversion_charge((V_P - 0.05) / phi_t + 1),
                         q_D = inversion_charge((V_P - d) / phi_t + 1);
            const double I = c.I_S * ((q_S * q_S + 2 * q_S) - (q_D * q_D + 2 * q_D)), scale = c.I_S * (q_S + q_D) * (q_S + q_D + 2);
            ASSERT_NEAR(out.i[D], I, 3e-12 * scale);
            ASSERT_NEAR(-out.di[D][S], 2 * c.I_S * q_S / phi_t, 3e-12 * scale / phi_t);
            ASSERT_NEAR(out.di[D][D], 2 * c.I_S * q_D / phi_t, 3e-12 * scale / phi_t);
            ASSERT_NEAR(out.di[D][G], 2 * c.I_S * (q_S - q_D) / (1.27 * phi_t), 3e-12 * scale / phi_t);
            ASSERT_NEAR(out.di[D][B], 0.27 * out.di[D][G], 3e-12 * scale / phi_t);  // g_mb / g_mg = n - 1
        }
}

TEST(Uicm, ForwardInversionIsThreeWhereThePinchOffVoltageIsTheSource) {
    const auto inside = Uicm<double>(constants_of_size(plain_card(), 1e-6, 1e-6)).internals({0.5, 0.461, 0, 0});
    EXPECT_NEAR(inside.q_S * (inside.q_S + 2), 3, 3e-15);
}

TEST(Uicm, InWeakInversionTheCurrentIsAnExponentialOfGateBulkAndSource) {  // eq. 42
    const auto c = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    for (double g = -0.3; g < 0.12; g += 0.05)
        for (const double b : {-0.1, 0.0, 0.1}) {
            const double I = 2 * std::numbers::e * c.I_S * std::exp((g + 0.27 * b - 0.461) / (1.27 * phi_t));
            EXPECT_NEAR(current(c, 0.9, g, 0, b), I, 2.1 * I * (I / (2 * c.I_S))) << g << ' ' << b;  // 1 - 2 q + q
        }
}

/// The plain model with a body effect. With the default phi, all of the slope factor is the depletion layer's.
UicmCard body_card() {
    UicmCard card = plain_card();
    card.gamma = 2 * (card.n - 1) * std::sqrt(card.phi);
    return card;
}

TEST(Uicm, WithABodyEffectTheGateVoltageIsTheIntegralOfTheSlopeFactorOverThePinchOffVoltage) {
    for (const double part : {1.0, 0.6}) {
        UicmCard card = body_card();
        card.gamma *= part;
        const auto c = constants_of_size(card, 1.5e-6, 0.5e-6);
        const double a = card.n - card.gamma / (2 * std::sqrt(card.phi));
        for (double V_P = -0.6; V_P < 1.5; V_P += 0.1) {
            const double u = a * V_P + card.gamma * (std::sqrt(card.phi + V_P) - std::sqrt(card.phi)),
                         n = a + card.gamma / (2 * std::sqrt(card.phi + V_P));
            const double v[4] = {V_P + 1, u + 0.461, V_P, 0};  // V_S = V_P, where i_f = 3
            const auto inside = Uicm<double>(c).internals(v);
            EXPECT_NEAR(inside.q_S * (inside.q_S + 2), 3, 2e-13) << V_P;
            const auto out = evaluate(c, v[D], v[G], v[S], 0);
            // I_S is proportional to n: dI/dV_G = g_ms / n + I n' / n^2, where n' = dn/dV_P
            const double n_by_P = -card.gamma / 4 * std::pow(card.phi + V_P, -1.5), I_S = c.I_S * n / card.n;
            EXPECT_NEAR(out.i[D], I_S * 3, 1e-9 * I_S) << V_P;
            EXPECT_NEAR(out.di[D][G], -out.di[D][S] / n + out.i[D] * n_by_P / (n * n), 1e-9 * I_S) << V_P;
        }
    }
}

TEST(Uicm, ABodyEffectReducesTheSlopeFactorAsTheGateVoltageRises) {
    const auto c = constants_of_size(body_card(), 1.5e-6, 0.5e-6), constant = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    const auto slope_factor = [](const UicmConstants& of, double v_sb) {  // in weak inversion, from the current at two gate voltages
        const double g = 0.35 + 1.27 * v_sb, dg = 1e-3;
        return dg / (phi_t * std::log(current(of, v_sb + 0.5, g + dg, v_sb) / current(of, v_sb + 0.5, g, v_sb)));
    };
    EXPECT_NEAR(slope_factor(constant, -0.3), slope_factor(constant, 0.6), 1e-9);
    EXPECT_GT(slope_factor(c, -0.3), slope_factor(c, 0) + 0.05);
    EXPECT_LT(slope_factor(c, 0.6), slope_factor(c, 0) - 0.03);
    EXPECT_NEAR(current(c, 0.5, 0.461, 0) / current(constant, 0.5, 0.461, 0), 1, 1e-12);  // V_P = 0
}

TEST(Uicm, WithABodyEffectCurrentAndChargesAreContinuousWhereTheSlopeFactorBecomesConstant) {
    const UicmCard card = body_card();
    const auto c = constants_of_size(card, 1.5e-6, 0.5e-6);
    const double V_P = -15.0 / 16 * card.phi, u = V_P + card.gamma * (std::sqrt(card.phi + V_P) - std::sqrt(card.phi)), e = 1e-7;
    const auto below = evaluate(c, 0.1, 0.461 + u - e, -0.4, 0), above = evaluate(c, 0.1, 0.461 + u + e, -0.4, 0);
    for (int k = 0; k < 4; ++k) {
        // of the oxide's capacitance: the inversion charge, which is almost 0 there, has a kink
        EXPECT_NEAR(above.q[k] - below.q[k], 2 * e * above.dq[k][G], 1e-6 * 2 * e * card.C_ox * 0.75e-12) << k;
        EXPECT_NEAR(above.dq[k][G], below.dq[k][G], 1e-6 * card.C_ox * 0.75e-12) << k;
    }
    EXPECT_NEAR(above.i[D] / below.i[D], 1, 1e-5);
}

TEST(Uicm, VelocitySaturationReducesTheCurrentInWeakInversionAndTheChargeInSaturation) {
    UicmCard card = plain_card();
    card.zeta_L = 0.05e-6;  // zeta 0.1
    const auto c = constants_of_size(card, 1.5e-6, 0.5e-6), without = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    EXPECT_NEAR(current(c, 0.9, -0.1, 0) / current(without, 0.9, -0.1, 0), 1 / 1.1, 1e-7);
    EXPECT_NEAR(current(c, 1e-6, -0.1, 0) / current(without, 1e-6, -0.1, 0), 1, 1e-5);
    for (double g = 0.2; g < 1.8; g += 0.2) {
        const double q = inversion_charge((g - 0.461) / 1.27 / phi_t + 1), i = current(c, 5, g, 0) / c.I_S;
        EXPECT_NEAR(2 * (q + 1 - std::sqrt(1 + i)) / i, 0.1, 1e-9) << g;  // the extraction formula of zeta
    }
}

/// Current (A) through elements in series with a common gate at g, from the voltage `to` to `from` (V), solved node by node.
double in_series(const std::vector<UicmConstants>& units, double to, double g, double from) {
    const auto end = [&](double I) {  // voltage of the last drain at current I
        double v = from;
        for (const auto& unit : units) {
            double low = v, high = to + 1e-9;
            for (int k = 0; k < 100; ++k) {
                const double mid = 0.5 * (low + high);
                (current(unit, mid, g, v) < I ? low : high) = mid;
            }
            v = 0.5 * (low + high);
        }
        return v;
    };
    double low = 0, high = current(units[0], to, g, from);
    for (int k = 0; k < 200; ++k) {
        const double mid = 0.5 * (low + high);
        (end(mid) < to ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

TEST(Uicm, AStackIsTheSeriesOfItsElementsInThePlainModel) {  // eq. 31, 32
    const auto unit = constants_of_size(plain_card(), 1.5e-6, 0.5e-6), wide = constants_of_size(plain_card(), 1.5e-6, 0.5e-6, 4);
    for (const double g : {0.2, 0.45, 0.8, 1.8})
        for (const double d : {0.02, 0.06}) {
            const double four = current(constants_of_size(plain_card(), 1.5e-6, 0.5e-6, 1, 4), d, g, 0);
            EXPECT_NEAR(in_series({unit, unit, unit, unit}, d, g, 0) / four, 1, 1e-9) << g << ' ' << d;
            const double both =
                current(constants_of_size(plain_card(), 1.5e-6 * 4 / 5, 0.5e-6), d, g, 0);  // S_D S_S / (S_D + S_S) with 1 and 4
            EXPECT_NEAR(in_series({unit, wide}, d, g, 0) / both, 1, 1e-9) << g << ' ' << d;
        }
}

TEST(Uicm, TheSplitMirrorDividesByItsAspectRatios) {  // eq. 38, 39
    for (const double N : {4.0, 8.0}) {
        const auto parallel = constants_of_size(plain_card(), 1.5e-6, 0.5e-6, N),
                   series = constants_of_size(plain_card(), 1.5e-6, 0.5e-6, 1, N);
        const double g = 0.35, I_in = current(parallel, g, g, 0);
        double low = 0, high = 0.35;
        for (int k = 0; k < 100; ++k) {  // the middle node, at which M_B's current equals the sum of M_C's and M_D's
            const double x = 0.5 * (low + high);
            (current(series, x, g, 0) < current(parallel, 0.7, g, x) + current(series, 0.35, g, x) ? low : high) = x;
        }
        EXPECT_NEAR(current(series, 0.35, g, low) / I_in * (N * N * (N * N + 2)), 1, 5e-4) << N;
    }
}

TEST(Uicm, ThermalNoiseIsNyquistsAtZeroDrainVoltageAndShotInSaturatedWeakInversion) {
    UicmCard card = plain_card();
    for (const double zeta_L : {0.0, 0.05e-6}) {
        card.zeta_L = zeta_L;
        const auto c = constants_of_size(card, 1.5e-6, 0.5e-6);
        for (double g = -0.2; g < 1.8; g += 0.2) {
            const double conductance = evaluate(c, 0.1, g, 0.1, 0).di[D][D];
            EXPECT_NEAR(Uicm<double>(c).noise({0.1, g, 0.1, 0}).thermal / (4 * boltzmann * 300.15 * conductance), 1, 1e-9) << g;
        }
    }
    const auto c = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    for (double g = -0.4; g < 0.11; g += 0.1)
        EXPECT_NEAR(Uicm<double>(c).noise({0.7, g, 0, 0}).thermal / (2 * elementary_charge * current(c, 0.7, g, 0)), 1, 1e-3) << g;
    const double strong = Uicm<double>(c).noise({3, 3, 0, 0}).thermal / (4 * boltzmann * 300.15 * -evaluate(c, 3, 3, 0, 0).di[D][S]);
    EXPECT_NEAR(strong, 2.0 / 3, 0.02);  // relative to g_ms, in saturated strong inversion
}

TEST(Uicm, FlickerNoiseAtTheGateDependsOnlyOnTheArea) {
    UicmCard card = plain_card();
    card.N_ot = 3e11;
    for (const double m : {1.0, 4.0})
        for (const double stack : {1.0, 8.0}) {
            const auto c = constants_of_size(card, 1.5e-6, 0.5e-6, m, stack);
            const double g_m = evaluate(c, 0.7, 0.1, 0, 0).di[D][G],
                         at_gate = Uicm<double>(c).noise({0.7, 0.1, 0, 0}).flicker / (g_m * g_m);
            const double expected = elementary_charge * elementary_charge * 3e11 / (card.C_ox * card.C_ox * 0.75e-12 * m * stack);
            EXPECT_NEAR(at_gate / expected, 1, 1e-3);
        }
}

TEST(Uicm, JunctionsFollowShockleyUpToTheirTangentAndHaveShotNoiseOfBothCurrents) {  // eq. 43
    const auto c = constants_of_size(full_card(), 1.5e-6, 0.5e-6);
    EXPECT_GT(c.I_sat_s, 0);
    for (double v = -0.5; v < 0.85; v += 0.05) {
        const auto inside = Uicm<double>(c).internals({0, -5, 0, v});
        EXPECT_NEAR(inside.I_s, c.I_sat_s * std::expm1(v / (1.05 * phi_t)), 1e-13 * std::abs(inside.I_s) + 1e-15 * c.I_sat_s) << v;
    }
    EXPECT_NEAR(Uicm<double>(c).internals({0, -5, 0, c.exp_limit_s / c.per_n_phi_t}).I_s, junction_current_limit, 1e-14);
    EXPECT_LT(Uicm<double>(c).internals({0, -5, 0, 5}).I_s, 2);
    EXPECT_TRUE(std::isfinite(evaluate(c, 1e3, -1e3, 1e3, -1e3).i[D]) && std::isfinite(evaluate(c, -1e3, 1e3, -1e3, 1e3).q[B]));
    const auto noise = Uicm<double>(c).noise({0, 0, 0, 0});
    EXPECT_NEAR(noise.shot_s, 4 * elementary_charge * c.I_sat_s, 1e-12 * noise.shot_s);
}

TEST(Uicm, CapacitancesAreThoseOfAcm2ForALongChannel) {
    const auto c = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    const double gate = 8.42e-3 * 0.75e-12;
    for (const double g : {-0.2, 0.4, 0.8, 1.5})
        for (const double d : {0.0, 0.1, 0.9}) {
            const auto out = evaluate(c, d, g, 0, 0);
            const auto inside = Uicm<double>(c).internals({d, g, 0, 0});
            const double q = inside.q_S, r = inside.q_D, a = (r + 1) / (q + 1), per = 1 / ((1 + a) * (1 + a));
            const double C_gs = 2.0 / 3 * gate * (1 + 2 * a) * per * q / (1 + q),
                         C_gd = 2.0 / 3 * gate * (a * a + 2 * a) * per * r / (1 + r);
            EXPECT_NEAR(-out.dq[G][S], C_gs, 1e-12 * gate);
            EXPECT_NEAR(-out.dq[G][D], C_gd, 1e-12 * gate);
            EXPECT_NEAR(-out.dq[G][B], 0.27 / 1.27 * (gate - C_gs - C_gd), 1e-12 * gate);
            EXPECT_NEAR(-out.dq[B][S], 0.27 * C_gs, 1e-12 * gate);
            const double C_ds = -4.0 / 15 * 1.27 * gate * (1 + 3 * a + a * a) / std::pow(1 + a, 3) * q / (1 + q);
            EXPECT_NEAR(-out.dq[D][S], C_ds, 1e-12 * gate);
        }
}

TEST(Uicm, DependsOnTemperatureAsSpecified) {
    const auto cold = constants_of_size(full_card(), 1e-6, 1e-6, 1, 1, false, -55),
               warm = constants_of_size(full_card(), 1e-6, 1e-6, 1, 1, false, 125);
    EXPECT_NEAR(cold.V_T, 0.461 + 0.4e-3 * 82, 1e-12);
    EXPECT_NEAR(warm.V_T, 0.461 - 0.4e-3 * 98, 1e-12);
    EXPECT_NEAR(warm.I_S / cold.I_S, std::sqrt(398.15 / 218.15), 1e-12);
    EXPECT_NEAR(1 / warm.per_phi_t, boltzmann * 398.15 / elementary_charge, 1e-15);
    const double expected =
        std::pow(398.15 / 300.15, 3 / 1.05) * std::exp((398.15 / 300.15 - 1) * 1.11 / (1.05 * boltzmann * 398.15 / elementary_charge));
    EXPECT_NEAR(warm.I_sat_s / constants_of_size(full_card(), 1e-6, 1e-6).I_sat_s / expected, 1, 1e-12);
}

TEST(Uicm, MismatchFallsWithTheRootOfTheTotalAreaAndDependsOnlyOnItsDevice) {
    UicmCard card = plain_card();
    card.A_VT = 2.8e-9, card.A_IS = 1e-8;
    UicmInstance at;
    at.W = 1.5e-6, at.L = 0.5e-6, at.m = 2, at.stack = 8;
    double sum = 0, squares = 0, logs = 0, together = 0;
    constexpr int chips = 20000;
    for (int k = 0; k < chips; ++k) {
        const auto sampled = with_mismatch(at, card, 1, 5, static_cast<std::uint64_t>(k));
        sum += sampled.delvto, squares += sampled.delvto * sampled.delvto, logs += std::pow(std::log(sampled.mulu0), 2);
        together += sampled.delvto * with_mismatch(at, card, 1, 6, static_cast<std::uint64_t>(k)).delvto;
    }
    const double sigma = 2.8e-9 / std::sqrt(12e-12);
    EXPECT_NEAR(sum / chips / sigma, 0, 0.03);
    EXPECT_NEAR(std::sqrt(squares / chips) / sigma, 1, 0.02);
    EXPECT_NEAR(std::sqrt(logs / chips) / (1e-8 / std::sqrt(12e-12)), 1, 0.02);
    EXPECT_NEAR(together / chips / (sigma * sigma), 0, 0.03);
    EXPECT_EQ(with_mismatch(at, card, 1, 5, 7).delvto, with_mismatch(at, card, 1, 5, 7).delvto);
    card.S_VT0 = 14e-3;
    EXPECT_NE(with_process(card, false, 1, 0).V_T0, with_process(card, true, 1, 0).V_T0);
    EXPECT_NE(with_process(card, false, 1, 0).V_T0, with_process(card, false, 1, 1).V_T0);
    EXPECT_EQ(with_process(card, false, 1, 1).V_T0, with_process(card, false, 1, 1).V_T0);
}

TEST(Uicm, ItsOperatingPointHasTheRegionAndConsistentConductances) {
    const auto n = constants_of_size(full_card(), 1.5e-6, 0.5e-6), p = constants_of_size(full_card(), 1.5e-6, 0.5e-6, 1, 1, true);
    const struct {
        double d, g;
        const char *inversion, *region;
    } cases[] = {{0.7, -0.5, "off", "off"},        {0.7, 0.3, "weak", "saturation"},
                 {0.05, 0.3, "weak", "triode"},    {0.7, 0.5, "moderate", "saturation"},
                 {0.2, 0.6, "moderate", "triode"}, {1.8, 1.8, "strong", "saturation"}};
    for (const auto& x : cases) {
        const auto a = uicm_operating_point(n, {x.d, x.g, 0, 0.3}), b = uicm_operating_point(p, {-x.d, -x.g, 0, -0.3});
        EXPECT_EQ(uicm_operating_point(n, {x.d, x.g, 0, 0}).inversion_level, x.inversion) << x.d << ' ' << x.g;
        EXPECT_EQ(uicm_operating_point(n, {x.d, x.g, 0, 0}).region, x.region) << x.d << ' ' << x.g;
        EXPECT_NEAR(a.g_mg + a.g_md + a.g_mb, a.g_ms, 1e-14 * a.g_ms);
        EXPECT_EQ(a.I_D, -b.I_D);
        EXPECT_EQ(a.g_mg, b.g_mg);
        EXPECT_EQ(a.C_gs, b.C_gs);
        EXPECT_EQ(a.V_T, b.V_T);
        EXPECT_LT(a.V_T, 0.461 + 0.01 * 0.6);
    }
}

}  // namespace
}  // namespace corpuscle::circuit
