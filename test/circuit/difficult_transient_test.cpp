// Transients that are hard for solvers: jumps, long rests, tiny currents, undamped oscillations.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// A source jumps by a volt in a nanosecond or a picosecond; the output behind a capacitor makes the same jump.
TEST(DifficultTransient, AJumpPassesThroughACapacitorCompletely) {
    for (const double rise : {1e-9, 1e-12}) {
        const double from = 1e-3, to = from + rise;
        const auto circuit = TransientRunner::from_text(
            fmt::format("jump\nv1 in 0 pwl(0 0 {:.17g} 0 {:.17g} 1)\nc1 in out 1u\nr1 out 0 1k\n.tran 10u 6m\n", from, to));
        const auto run = circuit.run({});
        ASSERT_EQ(run.error, "") << rise;
        const auto v = run.values(circuit.unknown("v(out)"));
        double worst = 0;
        for (std::size_t k = 0; k < v.size(); ++k) {
            const double exact = run.t[k] <= from ? 0 : run.t[k] < to ? (run.t[k] - from) / rise : std::exp(-(run.t[k] - to) / 1e-3);
            worst = std::max(worst, std::abs(v[k] - exact));
        }
        EXPECT_LT(worst, 3e-3) << rise;
    }
}

TEST(DifficultTransient, AJumpOfZeroDurationIsSimulatedOrRejected) {
    const auto netlist = parse_netlist_text("jump\nv1 in 0 pwl(0 0 1m 0 1m 1)\nc1 in out 1u\nr1 out 0 1k\n.tran 10u 6m\n");
    if (!netlist) return;
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

/// The thesis's filter B at 500 Hz, compared with .ac.
TEST(DifficultTransient, AFastSineHasTheAmplitudeAndPhaseOfAc) {
    const auto filter =
        TransientRunner::from_file(test::source_root() + "/circuits/high_pass.cir",
                                   {{"vf ", "vf vf 0 dc 0.35 ac 1 sin(0.35 0.02 500)"}, {".ac", ".ac lin 1 500 500\n.tran 1u 0.2"}});
    const auto run = filter.run({});
    ASSERT_EQ(run.error, "");
    EXPECT_GT(run.stats.steps, 100 * 8);  // over a hundred periods; steps of two periods would miss the sine
    EXPECT_LT(run.stats.steps, 100 * 1000);
    const auto gain = filter.first_ac_value("v(hpb)");
    const auto v = run.values(filter.unknown("v(hpb)"));
    double worst = 0, sum = 0, weight = 0;
    for (std::size_t k = 1; k < v.size(); ++k) {
        if (run.t[k] < 0.15) continue;
        sum += v[k] * (run.t[k] - run.t[k - 1]), weight += run.t[k] - run.t[k - 1];
    }
    const double middle = sum / weight;
    for (std::size_t k = 1; k < v.size(); ++k) {
        if (run.t[k] < 0.15) continue;
        const auto expected = gain * std::polar(1.0, two_pi * 500 * run.t[k]);
        worst = std::max(worst, std::abs(v[k] - middle - 0.02 * expected.imag()));
    }
    EXPECT_LT(worst, 0.02 * 0.02) << "V; the amplitude is 20 mV";
}

/// An hour of rest, then a pulse of a millisecond: the steps grow to seconds, and the pulse is still resolved.
TEST(DifficultTransient, AnHourOfRestCostsFewSteps) {
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

/// A transistor inverter, at rest for an hour, then switched.
TEST(DifficultTransient, AChipAtRestForAnHourCostsFewSteps) {
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

/// A coil of 1 mH and 10 ohm, switched on for 0.3 ms. Without current the switch has no conductance at all, or one, or is an S.
TEST(DifficultTransient, ACoilIsSwitchedWithAFreewheelDiode) {
    for (const char* element : {"b1 e 0 i=v(e)*(v(g)>2.5 ? 10 : 0)", "b1 e 0 i=v(e)*(v(g)>2.5 ? 10 : 1n)",
                                "s1 e 0 g 0 sm\n.model sm sw(vt=2.5 ron=0.1 roff=1g)"}) {
        const auto run =
            run_netlist(fmt::format("coil\nvdd vdd 0 12\nl1 vdd d 1m\nrl d e 10\n{}\nd1 e vdd dm\n.model dm d(is=1e-14)\n"
                                    "vg g 0 pulse(0 5 0.1m 1u 1u 0.3m 1m)\n.tran 1u 3m\n.meas tran peak max i(l1)\n"
                                    ".meas tran kick max v(e)\n",
                                    element));
        // On from 100.5 us to 401.5 us, through 10.1 ohm.
        EXPECT_NEAR(run.number("peak"), 12 / 10.1 * (1 - std::exp(-301e-6 * 10.1 / 1e-3)), 10 * 1e-5 * 1.13)
            << element << ": ten times the allowed error of a step";
        EXPECT_NEAR(run.number("kick"), 12 + 0.025865 * std::log(run.number("peak") / 1e-14), 1e-3) << element;
    }
}

/// The node of .ic is between a capacitor and a resistor. Released, it jumps to the voltage that the charge of the capacitor allows.
TEST(DifficultTransient, ANodeOfIcWithoutAChargeToGroundJumpsWhenItIsReleased) {
    const auto run = run_netlist(
        "released\nc1 x a 1u\nr1 a 0 1k\nr2 x 0 1k\n.ic v(a)=3\n.tran 10u 5m\n.meas tran begin find v(a) at=0\n"
        ".meas tran later find v(a) at=1m\n");
    EXPECT_NEAR(run.number("begin"), 1.5, 1e-5);
    EXPECT_NEAR(run.number("later"), 1.5 * std::exp(-0.5), 1e-4);
    const auto diode = run_netlist(
        "with a diode\nv1 in 0 1\nd1 in x dm\n.model dm d(is=1e-14)\nc1 x a 1u\nr1 a 0 1k\nr2 x 0 1k\n"
        ".ic v(a)=3\n.tran 10u 5m\n.meas tran begin find v(x,a) at=0\n");
    EXPECT_TRUE(diode.is_complete());
}

/// A bridge of four diodes without capacitance, with and without a capacitor behind it.
TEST(DifficultTransient, ABridgeOfDiodesWithoutCapacitanceRuns) {
    for (const char* capacitor : {"", "c1 p n 100u\n"}) {
        const auto run =
            run_netlist(fmt::format("bridge\nv1 a b sin(0 10 50)\nd1 a p dm\nd2 b p dm\nd3 n a dm\nd4 n b dm\nr1 p n 1k\n{}"
                                    "rg n 0 1meg\n.model dm d(is=1e-14)\n.tran 10u 60m\n.meas tran high max v(p,n)\n",
                                    capacitor));
        EXPECT_NEAR(run.number("high"), 10 - 2 * 0.72, 0.05);
    }
}

/// 1 fA into 1 fF: 1 V/s.
TEST(DifficultTransient, AFemtoampereChargesAFemtofarad) {
    const auto circuit = TransientRunner::from_text("tiny\ni1 0 a 1f\nc1 a 0 1f\nr1 a 0 1e21\n.ic v(a)=0\n.tran 1m 1\n");
    const auto run = circuit.run({});
    ASSERT_EQ(run.error, "");
    const auto v = run.values(circuit.unknown("v(a)"));
    for (std::size_t k = 0; k < v.size(); ++k) EXPECT_NEAR(v[k], run.t[k], 1e-3 * run.t[k] + 1e-6) << run.t[k];
}

/// A transistor's leakage discharges 1 fF from 0.3 V. There is no closed form; IDA is the reference.
TEST(DifficultTransient, ATransistorDischargesAFemtofaradAsInIda) {
    const auto circuit = TransientRunner::from_text(
        "leak\n.lib 'tsmc180.lib' tt\nr1 a 0 1e18\nc1 a 0 1f\nm1 a 0 0 0 nch w=1.5u l=0.5u stack=8\n.ic v(a)=0.3\n.tran 1m 5\n");
    const auto run = circuit.run({});
    ASSERT_EQ(run.error, "");
    IdaOptions options;
    options.output_times = run.t;
    const auto reference = circuit.run_ida(options);
    ASSERT_EQ(reference.error, "");
    const auto a = static_cast<std::size_t>(circuit.unknown("v(a)"));
    double worst = 0;
    for (std::size_t k = 1; k < run.t.size(); ++k) worst = std::max(worst, std::abs(run.x[k][a] - reference.x[k][a]));
    EXPECT_LT(reference.x.back()[a], 0.1);
    EXPECT_LT(worst, 1e-3);
}

struct FinalOscillation {
    double amplitude = 0, periods = 0;  ///< V (1 if undamped), and phase error in periods
    long steps = 0;
};

/// Oscillation of a lossless tank after a thousand of its periods, with at least a hundred steps per period.
FinalOscillation after_a_thousand_periods(double reltol, Integration method) {
    const auto circuit = TransientRunner::from_text(
        fmt::format("tank\nl1 a 0 1m\nc1 a 0 1u\nr1 a 0 1e15\n.ic v(a)=1\n.tran 1u {:.15g} uic\n", 1000 * two_pi * std::sqrt(1e-9)));
    TransientPlan plan;
    plan.reltol = reltol, plan.vntol = reltol / 10, plan.method = method, plan.max_step = two_pi * std::sqrt(1e-9) / 100;
    const auto run = circuit.run(plan);
    EXPECT_EQ(run.error, "");
    const auto v = run.x.back()[static_cast<std::size_t>(circuit.unknown("v(a)"))];
    const auto i = run.x.back()[static_cast<std::size_t>(circuit.unknown("i(l1)"))] * std::sqrt(1e-3 / 1e-6);  // scaled to volts
    return {std::hypot(v, i), std::atan2(i, v) / two_pi, run.stats.steps};
}

/// The trapezoidal rule conserves a tank's energy, with a phase lag of (w h)^2 / 12, here a third of a period. BDF would lose energy.
TEST(DifficultTransient, ATankKeepsItsAmplitudeOverAThousandPeriodsOfTheTrapezoidalRule) {
    const auto end = after_a_thousand_periods(1e-2, Integration::trapezoidal);
    EXPECT_NEAR(end.amplitude, 1, 1e-2);
    EXPECT_NEAR(std::abs(end.periods), 0.33, 0.05);
    RecordProperty("amplitude", fmt::format("{:.6f}", end.amplitude));
    RecordProperty("periods", fmt::format("{:.6f}", end.periods));
}

TEST(DifficultTransient, ATankKeepsItsAmplitudeAndPhaseAtTightTolerance) {
    for (const auto method : {Integration::bdf, Integration::trapezoidal}) {
        const auto end = after_a_thousand_periods(1e-7, method);
        EXPECT_NEAR(end.amplitude, 1, 1e-2) << end.steps;
        EXPECT_NEAR(end.periods, 0, 5e-2) << end.steps;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
