// Properties of the transistor that must hold for any card: derivatives, symmetry, conservation, smoothness, SIMD lanes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "circuit/uicm_cards.hpp"
#include "circuit/uicm_lanes.hpp"
#include "circuit/uicm_values.hpp"
#include "core/number/instruction_set.hpp"
#include "model/lanes/aligned_buffer.hpp"

namespace corpuscle::circuit {
namespace {

using namespace test;

/// Derivative of a value of the transistor with respect to v[by], computed with dual numbers. `read` selects the value.
template <class Read>
double dual_slope(const RandomDevice& r, int by, const Read& read) {
    num::Dual v[4] = {r.v[0], r.v[1], r.v[2], r.v[3]};
    v[by].d = 1;
    UicmEvaluation<num::Dual> out;
    Uicm<num::Dual>(r.c).eval(v, out);
    return read(out).d;
}

/// Compares two derivatives; the tolerance is relative to `scale`, the largest derivative of the same kind.
void expect_slope(double found, double expected, double scale, std::uint32_t k, const char* what, int a, int b) {
    EXPECT_LE(std::abs(found - expected), 2e-11 * scale)
        << what << '[' << a << "][" << b << "] of device " << k << ": " << found << ", not " << expected;
}

TEST(UicmContract, ItsSlopesEqualThoseOfDualNumbersAtAHundredThousandPoints) {
    for (std::uint32_t k = 0; k < 100000 && !testing::Test::HasFailure(); ++k) {
        const RandomDevice r(k);
        UicmEvaluation<double> out;
        Uicm<double>(r.c).eval(r.v, out);
        double max_i = 0, max_q = 0;
        for (int a = 0; a < 16; ++a)
            max_i = std::max(max_i, std::abs(out.di[a / 4][a % 4])), max_q = std::max(max_q, std::abs(out.dq[a / 4][a % 4]));
        const int b = static_cast<int>(k / 2 % 4);  // one direction per point
        for (int a = 0; a < 4; ++a) {
            expect_slope(out.di[a][b], dual_slope(r, b, [a](const auto& o) { return o.i[a]; }), max_i, k, "di", a, b);
            expect_slope(out.dq[a][b], dual_slope(r, b, [a](const auto& o) { return o.q[a]; }), max_q, k, "dq", a, b);
        }
    }
}

TEST(UicmContract, ItsSlopesEqualFiniteDifferences) {
    for (std::uint32_t k = 1; k < 4000; ++k) {
        if (k % 4 == 0) continue;  // V_DS = 0, where a second derivative may jump
        RandomDevice r(k);
        for (int b = 0; b < 4; ++b) {
            const double h = 1e-5;
            UicmEvaluation<double> at, up, down;
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

TEST(UicmContract, SwappingDrainAndSourceNegatesTheCurrentToTheLastBit) {
    for (std::uint32_t k = 0; k < 10000; ++k) {
        const RandomDevice r(k);
        const Uicm<double> device(r.c);
        const double forward = device.internals({r.v[0], r.v[1], r.v[2], r.v[3]}).I,
                     reversed = device.internals({r.v[2], r.v[1], r.v[0], r.v[3]}).I;
        ASSERT_EQ(forward, -reversed) << k;
        if (r.v[D] == r.v[S]) {
            ASSERT_EQ(forward, 0) << k;
        }
    }
}

TEST(UicmContract, APmosIsTheMirrorImageToTheLastBit) {
    for (std::uint32_t k = 0; k < 1000; ++k) {
        RandomDevice r(k);
        const auto one = evaluate(r.c, r.v[0], r.v[1], r.v[2], r.v[3]);
        r.c.polarity = -r.c.polarity;
        const auto other = evaluate(r.c, -r.v[0], -r.v[1], -r.v[2], -r.v[3]);
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

TEST(UicmContract, CurrentsAndChargesSumToZeroAndOnlyVoltageDifferencesMatter) {
    for (std::uint32_t k = 0; k < 10000; ++k) {
        const RandomDevice r(k);
        const auto out = evaluate(r.c, r.v[0], r.v[1], r.v[2], r.v[3]);
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

TEST(UicmContract, CurrentNeverFallsAsTheDrainRises) {
    UicmCard card = full_card();
    for (const double zeta : {0.0, 0.01, 0.1, 1.0, 10.0}) {
        card.zeta_L = zeta * 0.5e-6;
        const auto c = constants_of_size(card, 1.5e-6, 0.5e-6);
        for (double g = -0.5; g < 3; g += 0.25)
            for (double d = -0.5; d < 3; d += 0.01) ASSERT_GE(evaluate(c, d, g, 0, -0.6).di[D][D], 0) << zeta << ' ' << g << ' ' << d;
    }
}

TEST(UicmContract, SlopesDoNotJumpAtZeroDrainVoltageOrWhereAJunctionIsExtrapolated) {
    const auto c = constants_of_size(full_card(), 1.5e-6, 0.5e-6);
    // Junction voltages above which the current and the capacitance are extrapolated.
    const double current_limit = c.exp_limit_s / c.per_n_phi_t, capacitance_limit = c.v_limit;
    for (const double g : {-0.2, 0.3, 0.5, 1.0, 1.8})
        for (const double b : {0.0, capacitance_limit, current_limit})  // bulk voltage relative to source and drain
            for (const double step : {1e-9, 1e-8}) {
                const auto below = evaluate(c, -step, g, 0, b - step), above = evaluate(c, step, g, 0, b + step);
                for (int k = 0; k < 16; ++k) {
                    const auto difference = [&](const double(&x)[4][4], const double(&y)[4][4]) {
                        return std::abs(x[k / 4][k % 4] - y[k / 4][k % 4]);
                    };
                    ASSERT_LE(difference(below.di, above.di), 1000 * step * (std::abs(above.di[D][D]) + above.di[B][B])) << g << ' ' << b;
                    ASSERT_LE(difference(below.dq, above.dq), 1000 * step * (above.dq[G][G] + above.dq[B][B])) << g << ' ' << b;
                }
            }
}

TEST(UicmContract, ThePlainModelIsSmoothToThirdOrderAcrossZeroDrainVoltage) {
    const auto c = constants_of_size(plain_card(), 1.5e-6, 0.5e-6);
    for (const double g : {0.2, 0.5, 0.9}) {
        const double h = 2e-3, scale = evaluate(c, 0, g, 0, 0).di[D][D] / (phi_t * phi_t);
        const auto third = [&](double at) {  // third derivative of I_D with respect to V_DS, as a difference
            return (current(c, at + 2 * h, g, 0) - 2 * current(c, at + h, g, 0) + 2 * current(c, at - h, g, 0) -
                    current(c, at - 2 * h, g, 0)) /
                   (2 * h * h * h);
        };
        EXPECT_NEAR(third(-h), third(h), 0.3 * scale) << g;
        EXPECT_NEAR(third(-1e-5), third(1e-5), 2e-3 * scale) << g;
    }
}

TEST(UicmContract, LanesGiveTheSameBitsAsScalars) {
    constexpr std::size_t count = 2048;
    std::vector<UicmConstants> constants;
    lanes::AlignedBuffer<double> v[4] = {lanes::AlignedBuffer<double>(count), lanes::AlignedBuffer<double>(count),
                                         lanes::AlignedBuffer<double>(count), lanes::AlignedBuffer<double>(count)};
    for (std::uint32_t k = 0; k < count; ++k) {
        const RandomDevice r(k);
        constants.push_back(r.c);
        for (std::size_t n = 0; n < 4; ++n) v[n].data()[k] = r.v[n] * (k < 16 ? 1e3 : 1);
    }
    const double* const points[4] = {v[0].data(), v[1].data(), v[2].data(), v[3].data()};
    for (const auto set : instruction_sets().subspan(1)) {
        test::UicmBatchFunction evaluate_batch = test::baseline::uicm_evaluate_batch;
#ifdef CORPUSCLE_AVX
        if (set == InstructionSet::avx2) evaluate_batch = test::avx2::uicm_evaluate_batch;
        if (set == InstructionSet::avx512) evaluate_batch = test::avx512::uicm_evaluate_batch;
#endif
        std::vector<lanes::AlignedBuffer<double>> out;
        double* at[test::uicm_value_count];
        for (auto& p : at) p = out.emplace_back(count).data();
        evaluate_batch(constants.data(), points, count, at);
        for (std::size_t k = 0; k < count; ++k)
            test::for_each_value(
                Uicm<double>(constants[k]), {points[0][k], points[1][k], points[2][k], points[3][k]}, [&](std::size_t f, double expected) {
                    EXPECT_EQ(std::memcmp(&at[f][k], &expected, sizeof expected), 0)
                        << name_of(set) << " number " << f << " of device " << k << ": " << at[f][k] << ", not " << expected;
                });
    }
}

}  // namespace
}  // namespace corpuscle::circuit
