// Inputs in time that solvers find hard: jumps, long rests, tiny currents, rings that must not fade.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// A source jumps by a volt in a nanosecond or a picosecond; behind a capacitor all of it arrives.
TEST(DifficultInTime, AJumpGoesThroughACapacitorWhole) {
    for (const double rise : {1e-9, 1e-12}) {
        const double from = 1e-3, to = from + rise;
        const auto circuit =
            TransientRunner::from_text(fmt::format("jump\nv1 in 0 pwl(0 0 {:.17g} 0 {:.17g} 1)\nc1 in out 1u\nr1 out 0 1k\n.tran 10u 6m\n", from, to));
        const auto run = circuit.run({});
        ASSERT_EQ(run.error, "") << rise;
        const auto v = run.values(circuit.unknown("v(out)"));
        double most = 0;
        for (std::size_t k = 0; k < v.size(); ++k) {
            const double exact = run.t[k] <= from ? 0 : run.t[k] < to ? (run.t[k] - from) / rise : std::exp(-(run.t[k] - to) / 1e-3);
            most = std::max(most, std::abs(v[k] - exact));
        }
        EXPECT_LT(most, 3e-3) << rise;
    }
}

TEST(DifficultInTime, AJumpOfNoDurationIsTakenAsOne) {
    const auto netlist = parse_netlist_text("jump\nv1 in 0 pwl(0 0 1m 0 1m 1)\nc1 in out 1u\nr1 out 0 1k\n.tran 10u 6m\n");
    if (!netlist) return;  // said where it is read
    const auto circuit = netlist->elaborate({});
    if (!circuit) {
        EXPECT_NE(circuit.error().text().find("1"), std::string::npos);
        return;
    }
    const TransientRunner in(*netlist);
    const auto run = in.run({});
    ASSERT_EQ(run.error, "");
    const auto v = run.values(in.unknown("v(out)"));
    for (std::size_t k = 0; k < v.size(); ++k)
        if (run.t[k] > 1.0001e-3) {
            EXPECT_NEAR(v[k], std::exp(-(run.t[k] - 1e-3) / 1e-3), 2e-3) << run.t[k];
        }
}

/// The thesis's filter B under half a kilohertz: what .ac says arrives, no more and no later.
TEST(DifficultInTime, AFastSineGoesThroughTheFilterAsItsSpectrumSays) {
    const auto filter = TransientRunner::from_file(test::project_root() + "/circuits/high_pass.cir",
                                     {{"vf ", "vf vf 0 dc 0.35 ac 1 sin(0.35 0.02 500)"}, {".ac", ".ac lin 1 500 500\n.tran 1u 0.2"}});
    const auto run = filter.run({});
    ASSERT_EQ(run.error, "");
    EXPECT_GT(run.stats.steps, 100 * 8);  // of a hundred periods: whoever steps over two at a time sees nothing
    EXPECT_LT(run.stats.steps, 100 * 1000);
    const auto gain = filter.first_ac_value("v(hpb)");
    const auto v = run.values(filter.unknown("v(hpb)"));
    double most = 0, sum = 0, weight = 0;
    for (std::size_t k = 1; k < v.size(); ++k) {
        if (run.t[k] < 0.15) continue;
        sum += v[k] * (run.t[k] - run.t[k - 1]), weight += run.t[k] - run.t[k - 1];
    }
    const double middle = sum / weight;
    for (std::size_t k = 1; k < v.size(); ++k) {
        if (run.t[k] < 0.15) continue;
        const auto turned = gain * std::polar(1.0, two_pi * 500 * run.t[k]);
        most = std::max(most, std::abs(v[k] - middle - 0.02 * turned.imag()));
    }
    EXPECT_LT(most, 0.02 * 0.02) << "V, of 20 mV";
}

/// An hour in which nothing happens, then a pulse of a millisecond: steps of seconds, and then the pulse as it is.
TEST(DifficultInTime, AnHourOfRestCostsFewSteps) {
    const auto circuit = TransientRunner::from_text(
        "rest\nv1 in 0 pulse(0 1 3600 1u 1u 1m 1e6)\nr1 in out 1k\nc1 out 0 1u\nr2 out far 1meg\nc2 far 0 10n\n.tran 1m 3601\n");
    const auto run = circuit.run({});
    ASSERT_EQ(run.error, "");
    double longest = 0;
    long resting = 0;
    for (std::size_t k = 1; k < run.t.size(); ++k) {
        longest = std::max(longest, run.t[k] - run.t[k - 1]);
        resting += run.t[k] <= 3600;
    }
    EXPECT_GT(longest, 10);
    EXPECT_LT(resting, 200);
    EXPECT_LT(run.stats.steps, 2000);
    const auto v = run.values(circuit.unknown("v(out)"));
    const double top = *std::max_element(v.begin(), v.end());
    EXPECT_NEAR(top, (1 - std::exp(-1)), 2e-3);
}

/// The same with transistors: an oscillator held still for an hour, then let go.
TEST(DifficultInTime, AChipAtRestForAnHourCostsFewSteps) {
    const auto circuit = TransientRunner::from_text(
        "chip at rest\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\nvin in 0 pulse(0.1 0.6 3600 1m 1m 10m 1e6)\n"
        "mp out in vdd vdd pch w=6u l=0.5u m=2 stack=8\nmn out in 0 0 nch w=1.5u l=0.5u m=2 stack=8\nco out 0 1p\n.tran 1m 3601\n");
    const auto run = circuit.run({});
    ASSERT_EQ(run.error, "");
    long resting = 0;
    for (const double t : run.t) resting += t <= 3600;
    EXPECT_LT(resting, 300);
    EXPECT_LT(run.stats.steps, 5000);
    const auto v = run.values(circuit.unknown("v(out)"));
    EXPECT_LT(*std::min_element(v.begin(), v.end()), 0.05);
    EXPECT_GT(v.back(), 0.65);
}

/// 1 fA into 1 fF: a volt a second.
TEST(DifficultInTime, AFemtoampereChargesAFemtofarad) {
    const auto circuit = TransientRunner::from_text("tiny\ni1 0 a 1f\nc1 a 0 1f\nr1 a 0 1e21\n.ic v(a)=0\n.tran 1m 1\n");
    const auto run = circuit.run({});
    ASSERT_EQ(run.error, "");
    const auto v = run.values(circuit.unknown("v(a)"));
    for (std::size_t k = 0; k < v.size(); ++k) EXPECT_NEAR(v[k], run.t[k], 1e-3 * run.t[k] + 1e-6) << run.t[k];
}

/// A femtofarad at 0.3 V that a transistor's leakage empties: nothing else knows how fast but IDA.
TEST(DifficultInTime, AFemtofaradLeaksAwayAsItShould) {
    const auto circuit = TransientRunner::from_text(
        "leak\n.lib 'tsmc180.lib' tt\nr1 a 0 1e18\nc1 a 0 1f\nm1 a 0 0 0 nch w=1.5u l=0.5u stack=8\n.ic v(a)=0.3\n.tran 1m 5\n");
    const auto run = circuit.run({});
    ASSERT_EQ(run.error, "");
    IdaOptions asked;
    asked.output_times = run.t;
    const auto truth = circuit.run_ida(asked);
    ASSERT_EQ(truth.error, "");
    const auto a = static_cast<std::size_t>(circuit.unknown("v(a)"));
    double most = 0;
    for (std::size_t k = 1; k < run.t.size(); ++k) most = std::max(most, std::abs(run.x[k][a] - truth.x[k][a]));
    EXPECT_LT(truth.x.back()[a], 0.1);
    EXPECT_LT(most, 1e-3);
}

struct Faded {
    double amplitude = 0, turns = 0;  ///< of 1, and off in periods
    long steps = 0;
};

/// A tank without loss after a thousand of its periods, at a hundred steps a period or more.
Faded after_a_thousand_periods(double reltol, Integration method) {
    const auto circuit = TransientRunner::from_text(
        fmt::format("tank\nl1 a 0 1m\nc1 a 0 1u\nr1 a 0 1e15\n.ic v(a)=1\n.tran 1u {:.15g} uic\n", 1000 * two_pi * std::sqrt(1e-9)));
    TransientPlan plan;
    plan.reltol = reltol, plan.vntol = reltol / 10, plan.method = method, plan.max_step = two_pi * std::sqrt(1e-9) / 100;
    const auto run = circuit.run(plan);
    EXPECT_EQ(run.error, "");
    const auto v = run.x.back()[static_cast<std::size_t>(circuit.unknown("v(a)"))];
    const auto i = run.x.back()[static_cast<std::size_t>(circuit.unknown("i(l1)"))] * std::sqrt(1e-3 / 1e-6);  // as volts
    return {std::hypot(v, i), std::atan2(i, v) / two_pi, run.stats.steps};
}

/// The trapezoidal rule keeps a tank's energy; its time runs slow by (w h)^2 / 12, a third of a period here. BDF takes energy away.
TEST(DifficultInTime, ATankRingsAThousandPeriodsUnderTheTrapezoidalRule) {
    const auto kept = after_a_thousand_periods(1e-2, Integration::trapezoidal);
    EXPECT_NEAR(kept.amplitude, 1, 1e-2);
    EXPECT_NEAR(std::abs(kept.turns), 0.33, 0.05);
    RecordProperty("amplitude", fmt::format("{:.6f}", kept.amplitude));
    RecordProperty("periods", fmt::format("{:.6f}", kept.turns));
}

TEST(DifficultInTime, ATankFadesLittleInAThousandPeriodsAtTightTolerance) {
    for (const auto method : {Integration::bdf, Integration::trapezoidal}) {
        const auto kept = after_a_thousand_periods(1e-7, method);
        EXPECT_NEAR(kept.amplitude, 1, 1e-2) << kept.steps;
        EXPECT_NEAR(kept.turns, 0, 5e-2) << kept.steps;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
