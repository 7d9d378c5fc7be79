// The transistor against what must hold whatever its card says: slopes, symmetry, conservation, limits, noise, lanes.

#include "circuit/device/uicm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "circuit/device/uicm_card.hpp"
#include "circuit/device/uicm_point.hpp"
#include "circuit/uicm_lanes.hpp"
#include "circuit/uicm_numbers.hpp"
#include "model/lanes/buffer.hpp"
#include "signal/instruction_set.hpp"
#include "signal/random.hpp"

namespace corpuscle {
namespace {

constexpr double charge = 1.602176634e-19, boltzmann = 1.380649e-23, phi_t = boltzmann * 300.15 / charge;
enum { D, G, S, B };

/// UICM alone: no velocity saturation, no DIBL, no Early voltage to speak of, no junctions, no capacitance but the gate's.
UicmCard plain() {
    UicmCard card;
    card.V_E = 1e30;
    return card;
}

/// Every part of the model at work.
UicmCard whole() {
    UicmCard card;
    card.sigma_L = 5e-9, card.zeta_L = 0.02e-6, card.C_GSO = 3.7e-10, card.C_GDO = 3e-10, card.C_GBO = 1e-11;
    card.C_J = 1e-3, card.C_JSW = 2e-10, card.J_S = 1e-6, card.J_SSW = 1e-13, card.n_dio = 1.05, card.N_ot = 3e11;
    return card;
}

UicmConstants sized(const UicmCard& card, double W, double L, double m = 1, double stack = 1, bool pmos = false, double T = 27) {
    UicmInstance at;
    at.W = W, at.L = L, at.m = m, at.stack = stack;
    return uicm_constants(card, at, T, pmos);
}

UicmAnswer<double> answer(const UicmConstants& c, double d, double g, double s, double b) {
    UicmAnswer<double> out;
    Uicm<double>(c).eval({d, g, s, b}, out);
    return out;
}

double current(const UicmConstants& c, double d, double g, double s, double b = 0) { return Uicm<double>(c).inside({d, g, s, b}).I; }

/// Number k of a course of random devices and voltages: weak to strong inversion, forward bulks, V_DS of 0 in every fourth.
struct Random {
    UicmConstants c;
    double v[4];
    explicit Random(std::uint32_t k) {
        const auto z = [k](std::uint32_t what) { return normal(7, k, what, 0); };
        UicmCard card = whole();
        if (k % 3 == 0) card.sigma_L = 0;
        if (k % 5 == 0) card.zeta_L = 0;
        if (k % 7 == 0) card.zeta_L *= 20;
        c = sized(card, 1.5e-6, 0.5e-6, 1 + k % 4, 1 + k % 8, k % 2 == 1, -55 + 180 * (0.5 + 0.5 * std::tanh(z(4))));
        for (std::uint32_t n = 0; n < 4; ++n) v[n] = (k % 2 == 1 ? -1 : 1) * (0.3 + 0.45 * z(n));
        if (k % 16 < 4) v[G] *= 3;
        if (k % 4 == 0) v[S] = v[D] + (k % 8 == 0 ? 0 : 1e-7 * z(5));
    }
};

/// A transistor in duals with the slope of v[by] at 1.
template <class Read>
double dual_slope(const Random& r, int by, const Read& read) {
    num::Dual v[4] = {r.v[0], r.v[1], r.v[2], r.v[3]};
    v[by].d = 1;
    UicmAnswer<num::Dual> out;
    Uicm<num::Dual>(r.c).eval(v, out);
    return read(out).d;
}

/// As near as the largest slope of the same kind allows.
void near(double found, double right, double scale, std::uint32_t k, const char* what, int a, int b) {
    EXPECT_LE(std::abs(found - right), 2e-11 * scale)
        << what << '[' << a << "][" << b << "] of device " << k << ": " << found << ", not " << right;
}

TEST(Uicm, ItsSlopesAreThoseOfDualsAtAHundredThousandPoints) {
    for (std::uint32_t k = 0; k < 100000 && !testing::Test::HasFailure(); ++k) {
        const Random r(k);
        UicmAnswer<double> out;
        Uicm<double>(r.c).eval(r.v, out);
        double most_i = 0, most_q = 0;
        for (int a = 0; a < 16; ++a)
            most_i = std::max(most_i, std::abs(out.di[a / 4][a % 4])), most_q = std::max(most_q, std::abs(out.dq[a / 4][a % 4]));
        const int b = static_cast<int>(k / 2 % 4);  // one direction a point
        for (int a = 0; a < 4; ++a) {
            near(out.di[a][b], dual_slope(r, b, [a](const auto& o) { return o.i[a]; }), most_i, k, "di", a, b);
            near(out.dq[a][b], dual_slope(r, b, [a](const auto& o) { return o.q[a]; }), most_q, k, "dq", a, b);
        }
    }
}

TEST(Uicm, ItsSlopesAreThoseOfFiniteDifferences) {
    for (std::uint32_t k = 1; k < 4000; ++k) {
        if (k % 4 == 0) continue;  // V_DS = 0, where a second slope may jump
        Random r(k);
        for (int b = 0; b < 4; ++b) {
            const double h = 1e-5;
            UicmAnswer<double> at, up, down;
            const Uicm<double> device(r.c);
            device.eval(r.v, at);
            r.v[b] += h, device.eval(r.v, up), r.v[b] -= 2 * h, device.eval(r.v, down), r.v[b] += h;
            for (int a = 0; a < 4; ++a) {
                const double scale = std::abs(at.di[0][0]) + std::abs(at.di[1][1]) + std::abs(at.di[2][2]) + std::abs(at.di[3][3]);
                ASSERT_NEAR((up.i[a] - down.i[a]) / (2 * h), at.di[a][b], 2e-5 * scale + 1e-18) << k << ' ' << a << ' ' << b;
                ASSERT_NEAR((up.q[a] - down.q[a]) / (2 * h), at.dq[a][b], 2e-5 * at.dq[1][1] + 1e-22) << k << ' ' << a << ' ' << b;
            }
        }
    }
}

TEST(Uicm, SwappingDrainAndSourceNegatesTheCurrentToTheLastBit) {
    for (std::uint32_t k = 0; k < 10000; ++k) {
        const Random r(k);
        const Uicm<double> device(r.c);
        const double there = device.inside({r.v[0], r.v[1], r.v[2], r.v[3]}).I, back = device.inside({r.v[2], r.v[1], r.v[0], r.v[3]}).I;
        ASSERT_EQ(there, -back) << k;
        if (r.v[D] == r.v[S]) {
            ASSERT_EQ(there, 0) << k;
        }
    }
}

TEST(Uicm, APmosIsTheMirrorImageToTheLastBit) {
    for (std::uint32_t k = 0; k < 1000; ++k) {
        Random r(k);
        const auto one = answer(r.c, r.v[0], r.v[1], r.v[2], r.v[3]);
        r.c.polarity = -r.c.polarity;
        const auto other = answer(r.c, -r.v[0], -r.v[1], -r.v[2], -r.v[3]);
        for (int a = 0; a < 4; ++a) {
            ASSERT_EQ(one.i[a], -other.i[a]);
            ASSERT_EQ(one.q[a], -other.q[a]);
            for (int b = 0; b < 4; ++b) {
                ASSERT_EQ(one.di[a][b], other.di[a][b]);
                ASSERT_EQ(one.dq[a][b], other.dq[a][b]);
            }
        }
    }
}

TEST(Uicm, CurrentsAndChargesSumToNothingAndOnlyDifferencesOfVoltageCount) {
    for (std::uint32_t k = 0; k < 10000; ++k) {
        const Random r(k);
        const auto out = answer(r.c, r.v[0], r.v[1], r.v[2], r.v[3]);
        const auto sum = [](const double(&x)[4]) { return std::abs(x[0] + x[1] + x[2] + x[3]); };
        const auto size = [](const double(&x)[4]) { return std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]) + std::abs(x[3]); };
        ASSERT_LE(sum(out.i), 4e-16 * size(out.i)) << k;
        ASSERT_LE(sum(out.q), 4e-16 * size(out.q)) << k;
        for (int a = 0; a < 4; ++a) {
            ASSERT_LE(sum(out.di[a]), 4e-16 * size(out.di[a])) << k;
            ASSERT_LE(sum(out.dq[a]), 8e-16 * size(out.dq[a])) << k;
            const double column_i[4] = {out.di[0][a], out.di[1][a], out.di[2][a], out.di[3][a]};
            const double column_q[4] = {out.dq[0][a], out.dq[1][a], out.dq[2][a], out.dq[3][a]};
            ASSERT_LE(sum(column_i), 4e-16 * size(column_i)) << k;
            ASSERT_LE(sum(column_q), 8e-16 * size(column_q)) << k;
        }
    }
}

TEST(Uicm, PlainIsTheThesissModelWithItsDerivedSlopes) {  // eq. 21 to 30
    const auto c = sized(plain(), 1.5e-6, 0.5e-6);
    for (double g = 0; g < 1.5; g += 0.07)
        for (double d = 0; d < 1; d += 0.11) {
            const auto out = answer(c, d, g, 0.05, 0);
            const double V_P = (g - 0.461) / 1.27, q_S = inversion((V_P - 0.05) / phi_t + 1), q_D = inversion((V_P - d) / phi_t + 1);
            const double I = c.I_S * ((q_S * q_S + 2 * q_S) - (q_D * q_D + 2 * q_D)), scale = c.I_S * (q_S + q_D) * (q_S + q_D + 2);
            ASSERT_NEAR(out.i[D], I, 3e-12 * scale);
            ASSERT_NEAR(-out.di[D][S], 2 * c.I_S * q_S / phi_t, 3e-12 * scale / phi_t);
            ASSERT_NEAR(out.di[D][D], 2 * c.I_S * q_D / phi_t, 3e-12 * scale / phi_t);
            ASSERT_NEAR(out.di[D][G], 2 * c.I_S * (q_S - q_D) / (1.27 * phi_t), 3e-12 * scale / phi_t);
            ASSERT_NEAR(out.di[D][B], 0.27 * out.di[D][G], 3e-12 * scale / phi_t);  // g_mb / g_mg = n - 1
        }
}

TEST(Uicm, ForwardInversionIsThreeWhereThePinchOffVoltageIsTheSource) {
    const auto inside = Uicm<double>(sized(plain(), 1e-6, 1e-6)).inside({0.5, 0.461, 0, 0});
    EXPECT_NEAR(inside.q_S * (inside.q_S + 2), 3, 3e-15);
}

TEST(Uicm, InWeakInversionIsTheExponentialOfItsGateBulkAndSource) {  // eq. 42
    const auto c = sized(plain(), 1.5e-6, 0.5e-6);
    for (double g = -0.3; g < 0.12; g += 0.05)
        for (const double b : {-0.1, 0.0, 0.1}) {
            const double I = 2 * std::numbers::e * c.I_S * std::exp((g + 0.27 * b - 0.461) / (1.27 * phi_t));
            EXPECT_NEAR(current(c, 0.9, g, 0, b), I, 2.1 * I * (I / (2 * c.I_S))) << g << ' ' << b;  // 1 - 2 q + q
        }
}

TEST(Uicm, VelocitySaturationTakesItsShareInWeakInversionAndItsChargeInSaturation) {
    UicmCard card = plain();
    card.zeta_L = 0.05e-6;  // zeta 0.1
    const auto c = sized(card, 1.5e-6, 0.5e-6), without = sized(plain(), 1.5e-6, 0.5e-6);
    EXPECT_NEAR(current(c, 0.9, -0.1, 0) / current(without, 0.9, -0.1, 0), 1 / 1.1, 1e-7);
    EXPECT_NEAR(current(c, 1e-6, -0.1, 0) / current(without, 1e-6, -0.1, 0), 1, 1e-5);
    for (double g = 0.2; g < 1.8; g += 0.2) {
        const double q = inversion((g - 0.461) / 1.27 / phi_t + 1), i = current(c, 5, g, 0) / c.I_S;
        EXPECT_NEAR(2 * (q + 1 - std::sqrt(1 + i)) / i, 0.1, 1e-9) << g;  // how zeta is extracted
    }
}

TEST(Uicm, CurrentNeverFallsAsTheDrainRises) {
    UicmCard card = whole();
    for (const double zeta : {0.0, 0.01, 0.1, 1.0, 10.0}) {
        card.zeta_L = zeta * 0.5e-6;
        const auto c = sized(card, 1.5e-6, 0.5e-6);
        for (double g = -0.5; g < 3; g += 0.25)
            for (double d = -0.5; d < 3; d += 0.01) ASSERT_GE(answer(c, d, g, 0, -0.6).di[D][D], 0) << zeta << ' ' << g << ' ' << d;
    }
}

TEST(Uicm, SlopesDoNotJumpAcrossZeroDrainVoltageNorWhereAFormulaEnds) {
    const auto c = sized(whole(), 1.5e-6, 0.5e-6);
    const double top = c.top_s / c.per_n_phi_t, corner = c.v_top;
    for (const double g : {-0.2, 0.3, 0.5, 1.0, 1.8})
        for (const double b : {0.0, corner, top})  // of the bulk above source and drain
            for (const double step : {1e-9, 1e-8}) {
                const auto below = answer(c, -step, g, 0, b - step), above = answer(c, step, g, 0, b + step);
                for (int k = 0; k < 16; ++k) {
                    const auto far = [&](const double(&x)[4][4], const double(&y)[4][4]) {
                        return std::abs(x[k / 4][k % 4] - y[k / 4][k % 4]);
                    };
                    ASSERT_LE(far(below.di, above.di), 1000 * step * (std::abs(above.di[D][D]) + above.di[B][B])) << g << ' ' << b;
                    ASSERT_LE(far(below.dq, above.dq), 1000 * step * (above.dq[G][G] + above.dq[B][B])) << g << ' ' << b;
                }
            }
}

TEST(Uicm, PlainIsSmoothToThirdOrderAcrossZeroDrainVoltage) {
    const auto c = sized(plain(), 1.5e-6, 0.5e-6);
    for (const double g : {0.2, 0.5, 0.9}) {
        const double h = 2e-3, scale = answer(c, 0, g, 0, 0).di[D][D] / (phi_t * phi_t);
        const auto third = [&](double at) {  // of I_D, by V_DS
            return (current(c, at + 2 * h, g, 0) - 2 * current(c, at + h, g, 0) + 2 * current(c, at - h, g, 0) -
                    current(c, at - 2 * h, g, 0)) /
                   (2 * h * h * h);
        };
        EXPECT_NEAR(third(-h), third(h), 0.3 * scale) << g;
        EXPECT_NEAR(third(-1e-5), third(1e-5), 2e-3 * scale) << g;
    }
}

/// The current through units in series under one gate, from `from` to `to`, found node by node.
double in_series(const std::vector<UicmConstants>& units, double to, double g, double from) {
    const auto end = [&](double I) {  // where the last drain comes to lie under current I
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

TEST(Uicm, AStackIsTheSeriesOfItsUnitsInThePlainModel) {  // eq. 31, 32
    const auto unit = sized(plain(), 1.5e-6, 0.5e-6), wide = sized(plain(), 1.5e-6, 0.5e-6, 4);
    for (const double g : {0.2, 0.45, 0.8, 1.8})
        for (const double d : {0.02, 0.06}) {
            const double four = current(sized(plain(), 1.5e-6, 0.5e-6, 1, 4), d, g, 0);
            EXPECT_NEAR(in_series({unit, unit, unit, unit}, d, g, 0) / four, 1, 1e-9) << g << ' ' << d;
            const double both = current(sized(plain(), 1.5e-6 * 4 / 5, 0.5e-6), d, g, 0);  // S_D S_S / (S_D + S_S) with 1 and 4
            EXPECT_NEAR(in_series({unit, wide}, d, g, 0) / both, 1, 1e-9) << g << ' ' << d;
        }
}

TEST(Uicm, TheSplitMirrorDividesAsItsAspectRatiosSay) {  // eq. 38, 39
    for (const double N : {4.0, 8.0}) {
        const auto parallel = sized(plain(), 1.5e-6, 0.5e-6, N), series = sized(plain(), 1.5e-6, 0.5e-6, 1, N);
        const double g = 0.35, I_in = current(parallel, g, g, 0);
        double low = 0, high = 0.35;
        for (int k = 0; k < 100; ++k) {  // the middle node, where M_B's current is M_C's and M_D's
            const double x = 0.5 * (low + high);
            (current(series, x, g, 0) < current(parallel, 0.7, g, x) + current(series, 0.35, g, x) ? low : high) = x;
        }
        EXPECT_NEAR(current(series, 0.35, g, low) / I_in * (N * N * (N * N + 2)), 1, 5e-4) << N;
    }
}

TEST(Uicm, ThermalNoiseIsNyquistsAtZeroDrainVoltageAndShotInSaturatedWeakInversion) {
    UicmCard card = plain();
    for (const double zeta_L : {0.0, 0.05e-6}) {
        card.zeta_L = zeta_L;
        const auto c = sized(card, 1.5e-6, 0.5e-6);
        for (double g = -0.2; g < 1.8; g += 0.2) {
            const double conductance = answer(c, 0.1, g, 0.1, 0).di[D][D];
            EXPECT_NEAR(Uicm<double>(c).noise({0.1, g, 0.1, 0}).thermal / (4 * boltzmann * 300.15 * conductance), 1, 1e-9) << g;
        }
    }
    const auto c = sized(plain(), 1.5e-6, 0.5e-6);
    for (double g = -0.4; g < 0.11; g += 0.1)
        EXPECT_NEAR(Uicm<double>(c).noise({0.7, g, 0, 0}).thermal / (2 * charge * current(c, 0.7, g, 0)), 1, 1e-3) << g;
    const double strong = Uicm<double>(c).noise({3, 3, 0, 0}).thermal / (4 * boltzmann * 300.15 * -answer(c, 3, 3, 0, 0).di[D][S]);
    EXPECT_NEAR(strong, 2.0 / 3, 0.02);  // of g_ms, in saturated strong inversion
}

TEST(Uicm, FlickerNoiseIsFoundAtTheGateByAreaAlone) {
    UicmCard card = plain();
    card.N_ot = 3e11;
    for (const double m : {1.0, 4.0})
        for (const double stack : {1.0, 8.0}) {
            const auto c = sized(card, 1.5e-6, 0.5e-6, m, stack);
            const double g_m = answer(c, 0.7, 0.1, 0, 0).di[D][G], at_gate = Uicm<double>(c).noise({0.7, 0.1, 0, 0}).flicker / (g_m * g_m);
            const double right = charge * charge * 3e11 / (card.C_ox * card.C_ox * 0.75e-12 * m * stack);
            EXPECT_NEAR(at_gate / right, 1, 1e-3);
        }
}

TEST(Uicm, JunctionsAreShockleysUpToTheirTangentAndNoisyAsTwoShotCurrents) {  // eq. 43
    const auto c = sized(whole(), 1.5e-6, 0.5e-6);
    EXPECT_GT(c.I_sat_s, 0);
    for (double v = -0.5; v < 0.85; v += 0.05) {
        const auto inside = Uicm<double>(c).inside({0, -5, 0, v});
        EXPECT_NEAR(inside.I_s, c.I_sat_s * std::expm1(v / (1.05 * phi_t)), 1e-13 * std::abs(inside.I_s) + 1e-15 * c.I_sat_s) << v;
    }
    EXPECT_NEAR(Uicm<double>(c).inside({0, -5, 0, c.top_s / c.per_n_phi_t}).I_s, junction_current_top, 1e-14);
    EXPECT_LT(Uicm<double>(c).inside({0, -5, 0, 5}).I_s, 2);
    EXPECT_TRUE(std::isfinite(answer(c, 1e3, -1e3, 1e3, -1e3).i[D]) && std::isfinite(answer(c, -1e3, 1e3, -1e3, 1e3).q[B]));
    const auto noise = Uicm<double>(c).noise({0, 0, 0, 0});
    EXPECT_NEAR(noise.shot_s, 4 * charge * c.I_sat_s, 1e-12 * noise.shot_s);
}

TEST(Uicm, CapacitancesAreAcm2sForALongChannel) {
    const auto c = sized(plain(), 1.5e-6, 0.5e-6);
    const double gate = 8.42e-3 * 0.75e-12;
    for (const double g : {-0.2, 0.4, 0.8, 1.5})
        for (const double d : {0.0, 0.1, 0.9}) {
            const auto out = answer(c, d, g, 0, 0);
            const auto inside = Uicm<double>(c).inside({d, g, 0, 0});
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

TEST(Uicm, FollowsTemperatureByItsLaws) {
    const auto cold = sized(whole(), 1e-6, 1e-6, 1, 1, false, -55), warm = sized(whole(), 1e-6, 1e-6, 1, 1, false, 125);
    EXPECT_NEAR(cold.V_T, 0.461 + 0.4e-3 * 82, 1e-12);
    EXPECT_NEAR(warm.V_T, 0.461 - 0.4e-3 * 98, 1e-12);
    EXPECT_NEAR(warm.I_S / cold.I_S, std::sqrt(398.15 / 218.15), 1e-12);
    EXPECT_NEAR(1 / warm.per_phi_t, boltzmann * 398.15 / charge, 1e-15);
    const double right =
        std::pow(398.15 / 300.15, 3 / 1.05) * std::exp((398.15 / 300.15 - 1) * 1.11 / (1.05 * boltzmann * 398.15 / charge));
    EXPECT_NEAR(warm.I_sat_s / sized(whole(), 1e-6, 1e-6).I_sat_s / right, 1, 1e-12);
}

TEST(Uicm, MismatchFallsWithTheRootOfTheWholeArraysAreaAndDependsOnWhatItIsForAlone) {
    UicmCard card = plain();
    card.A_VT = 2.8e-9, card.A_IS = 1e-8;
    UicmInstance at;
    at.W = 1.5e-6, at.L = 0.5e-6, at.m = 2, at.stack = 8;
    double sum = 0, squares = 0, logs = 0, together = 0;
    constexpr int chips = 20000;
    for (int k = 0; k < chips; ++k) {
        const auto drawn = with_mismatch(at, card, 1, 5, static_cast<std::uint64_t>(k));
        sum += drawn.delvto, squares += drawn.delvto * drawn.delvto, logs += std::pow(std::log(drawn.mulu0), 2);
        together += drawn.delvto * with_mismatch(at, card, 1, 6, static_cast<std::uint64_t>(k)).delvto;
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

TEST(Uicm, ItsPointSaysTheRegionAndConductancesThatSumUp) {
    const auto n = sized(whole(), 1.5e-6, 0.5e-6), p = sized(whole(), 1.5e-6, 0.5e-6, 1, 1, true);
    const struct {
        double d, g;
        const char *inversion, *region;
    } cases[] = {{0.7, -0.5, "off", "off"},        {0.7, 0.3, "weak", "saturation"},
                 {0.05, 0.3, "weak", "triode"},    {0.7, 0.5, "moderate", "saturation"},
                 {0.2, 0.6, "moderate", "triode"}, {1.8, 1.8, "strong", "saturation"}};
    for (const auto& x : cases) {
        const auto a = uicm_point(n, {x.d, x.g, 0, 0.3}), b = uicm_point(p, {-x.d, -x.g, 0, -0.3});
        EXPECT_EQ(uicm_point(n, {x.d, x.g, 0, 0}).inversion, x.inversion) << x.d << ' ' << x.g;
        EXPECT_EQ(uicm_point(n, {x.d, x.g, 0, 0}).region, x.region) << x.d << ' ' << x.g;
        EXPECT_NEAR(a.g_mg + a.g_md + a.g_mb, a.g_ms, 1e-14 * a.g_ms);
        EXPECT_EQ(a.I_D, -b.I_D);
        EXPECT_EQ(a.g_mg, b.g_mg);
        EXPECT_EQ(a.C_gs, b.C_gs);
        EXPECT_EQ(a.V_T, b.V_T);
        EXPECT_LT(a.V_T, 0.461 + 0.01 * 0.6);
    }
}

TEST(Uicm, LanesGiveTheBitsOfOne) {
    constexpr std::size_t count = 2048;
    std::vector<UicmConstants> constants;
    lanes::Buffer<double> v[4] = {lanes::Buffer<double>(count), lanes::Buffer<double>(count), lanes::Buffer<double>(count),
                                  lanes::Buffer<double>(count)};
    for (std::uint32_t k = 0; k < count; ++k) {
        const Random r(k);
        constants.push_back(r.c);
        for (std::size_t n = 0; n < 4; ++n) v[n].data()[k] = r.v[n] * (k < 16 ? 1e3 : 1);
    }
    const double* const points[4] = {v[0].data(), v[1].data(), v[2].data(), v[3].data()};
    for (const auto set : instruction_sets().subspan(1)) {
        test::UicmMany many = test::baseline::uicm_many;
#ifdef __x86_64__
        if (set == InstructionSet::avx2) many = test::avx2::uicm_many;
        if (set == InstructionSet::avx512) many = test::avx512::uicm_many;
#endif
        std::vector<lanes::Buffer<double>> out;
        double* at[test::uicm_numbers];
        for (auto& p : at) p = out.emplace_back(count).data();
        many(constants.data(), points, count, at);
        for (std::size_t k = 0; k < count; ++k)
            test::each_number(Uicm<double>(constants[k]), {points[0][k], points[1][k], points[2][k], points[3][k]},
                              [&](std::size_t f, double right) {
                                  EXPECT_EQ(std::memcmp(&at[f][k], &right, sizeof right), 0)
                                      << name_of(set) << " number " << f << " of device " << k << ": " << at[f][k] << ", not " << right;
                              });
    }
}

}  // namespace
}  // namespace corpuscle
