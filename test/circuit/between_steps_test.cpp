// Points that a transient reports between its steps and right after a breakpoint, for circuits with closed-form solutions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circuit/device/source_waveform.hpp"
#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double one_turn = 2 * std::numbers::pi;

/// Largest difference between a curve, interpolated linearly between its points, and its exact value.
template <class Exact>
double max_deviation(const NetlistRun& run, const std::string& curve, const Exact& exact, double from = 0) {
    const auto t = run.curve("time"), v = run.curve(curve);
    double worst = 0;
    for (std::size_t k = 1; k < t.size(); ++k)
        for (const double fraction : {0.0, 0.5, 1.0}) {
            const double at = t[k - 1] + fraction * (t[k] - t[k - 1]);
            if (at >= from) worst = std::max(worst, std::abs(v[k - 1] + fraction * (v[k] - v[k - 1]) - exact(at)));
        }
    return worst;
}

const std::string slow_inverter =
    "inverter\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\nvin in 0 sin(0.35 0.35 1k)\nmp out in vdd vdd pch w=1.5u l=0.5u\n"
    "mn out in 0 0 nch w=1.5u l=0.5u\n";

TEST(BetweenSteps, AnInverterStaysBetweenItsRails) {
    const auto run = run_netlist(slow_inverter +
                                 ".tran 1u 3m\n.meas tran low min v(out)\n.meas tran high max v(out)\n"
                                 ".meas tran edge when v(out)=0.35 rise=1\n");
    EXPECT_GT(run.number("low"), -1e-5);
    EXPECT_LT(run.number("high"), 0.7 + 1e-5);
    EXPECT_GT(run.number("high"), 0.7 - 1e-3);
    const auto fine = run_netlist(slow_inverter + ".options accuracy=finest\n.tran 1u 3m 0 1u\n.meas tran edge when v(out)=0.35 rise=1\n");
    EXPECT_NEAR(run.number("edge"), fine.number("edge"), 20e-9);
}

TEST(BetweenSteps, ASineOverAResistorIsASine) {
    const auto run = run_netlist(
        "sine\nv1 in 0 sin(0 1 1k)\nr1 in out 1k\nr2 out 0 1k\n.tran 1u 3m\n"
        ".meas tran top max v(in)\n.meas tran half max v(out)\n.meas tran rms rms v(in)\n.meas tran i max i(v1)\n");
    EXPECT_NEAR(run.number("top"), 1, 2e-5);
    EXPECT_NEAR(run.number("half"), 0.5, 2e-5);
    EXPECT_NEAR(run.number("rms"), std::sqrt(0.5), 5e-5);
    EXPECT_NEAR(run.number("i"), 0.5e-3, 2e-8);
    const auto sine = [](double t) { return std::sin(one_turn * 1e3 * t); };
    EXPECT_LT(max_deviation(run, "v(in)", sine), 1e-4);
    EXPECT_LT(max_deviation(run, "v(out)", [&](double t) { return sine(t) / 2; }), 1e-4);
}

TEST(BetweenSteps, ASourceFollowsItsWaveform) {
    const auto run = run_netlist(
        "cap\nv1 in 0 sin(0.2 1 1k)\nv2 top in 2\nc1 top 0 1n\nr1 top 0 1meg\n.tran 100u 3m\n.meas tran top max v(in)\n"
        ".meas tran sum max v(top)\n.meas tran low min v(in)\n");
    const auto sine = [](double t) { return 0.2 + std::sin(one_turn * 1e3 * t); };
    EXPECT_NEAR(run.number("top"), 1.2, 3e-5);
    EXPECT_NEAR(run.number("low"), -0.8, 3e-5);
    EXPECT_NEAR(run.number("sum"), 3.2, 1e-4);
    EXPECT_LT(max_deviation(run, "v(in)", sine), 1e-4);
    EXPECT_LT(max_deviation(run, "v(top)", [&](double t) { return sine(t) + 2; }), 1e-4);
    const auto current = [&](double t) { return -(1e-9 * one_turn * 1e3 * std::cos(one_turn * 1e3 * t) + (sine(t) + 2) / 1e6); };
    EXPECT_LT(max_deviation(run, "i(v1)", current, 1e-5), 1e-4 * 1e-5);
}

TEST(BetweenSteps, ADiodeBlocksReverseCurrent) {
    const auto run = run_netlist(
        "diode\nv1 in 0 sin(0 5 1k)\nd1 in out d\nr1 out 0 1k\n.model d d(is=1e-14)\n.tran 1u 3m\n"
        ".meas tran low min v(out)\n.meas tran high max v(out)\n.meas tran i max i(v1)\n");
    EXPECT_GT(run.number("low"), -1e-5);
    EXPECT_LT(run.number("i"), 1e-8);
    // 5 V = v + V_T ln(1 + v / 1k / 10 fA)
    double v = 4;
    for (int k = 0; k < 50; ++k) v = 5 - 0.0258649 * std::log1p(v / 1e3 / 1e-14);
    EXPECT_NEAR(run.number("high"), v, 1e-4);
}

TEST(BetweenSteps, TwoDiodesClampTheirNode) {
    const auto run = run_netlist(
        "two\nv1 in 0 sin(0 5 1k)\nr1 in out 1k\nd1 out 0 d\nd2 0 out d\nc1 out 0 10f\n.model d d(is=1e-14)\n"
        ".tran 1u 3m\n.meas tran low min v(out)\n.meas tran high max v(out)\n");
    double v = 0.7;
    for (int k = 0; k < 50; ++k) v = 0.0258649 * std::log1p((5 - v) / 1e3 / 1e-14);
    EXPECT_NEAR(run.number("high"), v, 1e-4);
    EXPECT_NEAR(run.number("low"), -v, 1e-4);
}

/// An inductor's voltage and a capacitor's current jump where the source starts to rise. An extra point follows the breakpoint.
TEST(AfterABreakpoint, AJumpIsNotReportedAsARamp) {
    const auto run = run_netlist(
        "corner\nv1 a 0 pwl(0 0 1m 0 2m 1 3m 1)\nc1 a 0 1u\ni1 0 b pwl(0 0 1m 0 2m 1m 3m 1m)\nl1 b c 1m\nr1 c 0 1k\n"
        ".tran 10u 3m\n");
    const auto t = run.curve("time"), i = run.curve("i(v1)"), b = run.curve("v(b)"), c = run.curve("v(c)");
    double first_delay = 1;  // s
    for (std::size_t k = 0; k < t.size(); ++k) {
        const bool inside = t[k] > 1e-3 && t[k] <= 2e-3;
        EXPECT_NEAR(i[k], inside ? -1e-3 : 0, 1e-7) << t[k];
        EXPECT_NEAR(b[k] - c[k], inside ? 1e-3 : 0, 1e-6) << t[k];
        if (t[k] > 1e-3) first_delay = std::min(first_delay, t[k] - 1e-3);
    }
    EXPECT_LT(first_delay, 1e-9);
    const auto ramps = run_netlist(
        "exp\nv1 a 0 exp(0 1 1m 0.1m 2m 0.2m)\nc1 a 0 1n\n.tran 10u 4m\n.meas tran low min i(v1)\n"
        ".meas tran high max i(v1)\n");
    EXPECT_NEAR(ramps.number("low"), -1e-9 / 0.1e-3, 1e-9);
    EXPECT_NEAR(ramps.number("high"), 1e-9 / 0.2e-3 * (1 - std::exp(-10)), 1e-9);
}

/// 1 ps after a breakpoint a source has changed by a few nV; its value must not lose this change to rounding.
TEST(AfterABreakpoint, ASourceIsAccurateToItsLastDigits) {
    const double since = 1e-12, slope = 4e3;  // s, V/s: 4 nV of 4 V
    const SourceWaveform charges({Waveform::Shape::exponential, 0, false, 0, 0, {0, 4, 2e-4, 1e-3, 1, 1}}, 1e-6, 3e-3);
    const double late = 2e-4 + since;
    EXPECT_NEAR(charges.at(late), slope * (late - 2e-4), 1e-9 * slope * since);
    const SourceWaveform returns({Waveform::Shape::pulse, 0, false, 0, 0, {4, 0, 1e-4, 3e-5, 1e-3, 2e-4, 2e-3}}, 1e-6, 3e-3);
    const double corner = returns.next_breakpoint(2e-4), then = corner + since;
    EXPECT_EQ(returns.at(corner), 0);
    EXPECT_NEAR(returns.at(then), slope * (then - corner), 1e-9 * slope * since);
}

/// If the charge were computed at the limited voltage of a Newton iteration, it would cause a current of 15 mA for one step.
TEST(AfterABreakpoint, JunctionsStartWithTheChargeOfTheirVoltage) {
    const auto circuit = TransientRunner::from_text(
        "two in series\nv1 a 0 exp(-1.98516 1.98516 0.3m 0.44m)\nd1 b a d\nd2 0 b d\nr1 a b 33meg\nc1 a 0 1n\n"
        ".model d d(is=1.68381e-13 n=1.30859 cjo=5.99394e-14)\n.tran 1u 1m\n");
    TransientPlan plan;
    plan.all_reported = true;
    const auto run = circuit.run(plan);
    const auto i = static_cast<std::size_t>(circuit.unknown("i(v1)"));
    ASSERT_EQ(run.error, "");
    ASSERT_LT(run.t[1], 1e-12);
    EXPECT_GT(std::abs(run.x[0][i]), 0.1);
    for (std::size_t k = 1; run.t[k] < 1e-4; ++k) EXPECT_NEAR(run.x[k][i], run.x[0][i], 1e-6) << run.t[k];
}

/// A steep edge passes through a floating capacitor, at tolerances near the rounding error.
TEST(AfterABreakpoint, RoundingErrorsRejectNoStep) {
    const auto circuit = TransientRunner::from_text(
        "floating\nv1 a 0 pulse(-1.785 1.785 0.27m 1.6u 0.9u 0.28m 1.36m)\nr1 a b 43.9k\nr2 b 0 64.4k\nr3 a c 4.5meg\nd1 a c d\n"
        "c1 c b 1.24n\nd2 c e d\nr4 e 0 4.67k\n.model d d(is=1.46257e-12 n=1.20338 cjo=0)\n.tran 1u 3m\n");
    TransientPlan plan;
    plan.all_reported = true;
    plan.reltol = 1e-8, plan.vntol = 1e-9, plan.abstol = 1e-19;
    for (const double max_step : {60e-6, 30e-6, 15e-6}) {
        plan.max_step = max_step;
        const auto run = circuit.run(plan);
        EXPECT_EQ(run.error, "") << max_step;
        EXPECT_LT(run.stats.steps, 20'000) << max_step;
    }
}

/// A comparator has no charge and sets no breakpoint; its edge is at the time at which its input crosses the threshold.
TEST(BetweenSteps, AnExpressionJumpsWhereItsInputCrossesTheThreshold) {
    const auto run = run_netlist(
        "comparator\nv1 in 0 sin(0 1 1k)\nb1 out 0 v=u(v(in)-0.3)\nr1 out 0 1k\nc1 far 0 1n\nr2 out far 10k\n.tran 1u 3m\n"
        ".meas tran first when v(out)=0.5 rise=1\n.meas tran last when v(out)=0.5 fall=3\n.meas tran high max v(out)\n"
        ".meas tran low min v(out)\n");
    const double up = std::asin(0.3) / one_turn * 1e-3;
    EXPECT_NEAR(run.number("first"), up, 1e-8);
    EXPECT_NEAR(run.number("last"), 2e-3 + 0.5e-3 - up, 1e-8);
    EXPECT_NEAR(run.number("low"), 0, 1e-6);
    EXPECT_NEAR(run.number("high"), 1, 1e-6);
}

/// i(v2) is the current of the expression. Only v(a) has charge and an error estimate, and it hardly changes at the jump.
TEST(AcceptedPoints, SatisfyTheEquationsWhereAnExpressionJumps) {
    const auto run = run_netlist(
        "jump\ni1 0 a pulse(-1u 1u 0 1n 1n 0.3m 0.6m)\nc1 a 0 1n\nr1 a 0 100meg\nv2 b 0 1\nb1 b 0 i=50u*u(v(a)-0.1)\n"
        ".ic v(a)=0\n.tran 1u 3m\n");
    const auto a = run.curve("v(a)"), i = run.curve("i(v2)"), t = run.curve("time");
    int jumps = 0;
    for (std::size_t k = 1; k < a.size(); ++k) {
        if (std::abs(a[k] - 0.1) > 2e-5) {
            EXPECT_NEAR(i[k], a[k] > 0.1 ? -50e-6 : 0, 1e-9) << t[k] << " " << a[k];
        }
        jumps += (i[k] < -20e-6) != (i[k - 1] < -20e-6);
    }
    EXPECT_EQ(jumps, 10);
}

/// The output node has no charge. The time of its crossing within a step is as accurate as the steps.
TEST(BetweenSteps, ASpikeOfANodeWithoutChargeIsLocatedWithinAStep) {
    const auto run = run_netlist(slow_inverter + ".spike v(out) 0.35\n.tran 50u 5m 0 100u\n");
    const auto fine = run_netlist(slow_inverter + ".spike v(out) 0.35\n.options accuracy=fine\n.tran 1u 5m 0 1u\n");
    ASSERT_EQ(run.number("spikes"), 5);
    ASSERT_EQ(fine.number("spikes"), 5);
    EXPECT_NEAR(run.number("first_spike"), fine.number("first_spike"), 20e-9);
    EXPECT_NEAR(run.number("last_spike"), fine.number("last_spike"), 20e-9);
}

}  // namespace
}  // namespace corpuscle::circuit
