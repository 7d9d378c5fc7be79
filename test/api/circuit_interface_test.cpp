// The public interface of circuits: closed forms, the netlist's own analyses, errors.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "corpuscle/circuit.hpp"

namespace {

using corpuscle::Circuit;

constexpr const char* rc = R"(RC low-pass
.param r=1k
v1 in 0 dc 1 ac 1 pulse(0 1 0 1n 1n 1 2)
r1 in out {r}
c1 out 0 1u
.ac dec 10 1 1meg
.tran 10u 5m
.meas tran tau when v(out)=0.632120559
.meas ac corner when vdb(out)=-3.0103
.end
)";

std::string message_of(const std::function<void()>& run) {
    try {
        run();
    } catch (const corpuscle::InputError& e) {
        return e.what();
    }
    return "no error";
}

TEST(CircuitInterface, AnalysesAgreeWithClosedForms) {
    const auto circuit = Circuit::from_text(rc);
    EXPECT_EQ(circuit.op().column("v(out)").values, std::vector{1.0});
    const auto dc = circuit.dc("V1", "0", "1", "0.25");
    EXPECT_EQ(dc.column("V(OUT)").values.size(), 5u);
    EXPECT_NEAR(dc.column("i(v1)").values[4], 0, 1e-9);
    const auto ac = circuit.ac("dec", "10", "1", "1Meg");
    const auto f = ac.column("frequency");
    EXPECT_EQ(f.unit, "Hz");
    const auto out = ac.column("v(out)");
    ASSERT_EQ(out.complex_values.size(), 61u);
    for (std::size_t k = 0; k < f.values.size(); ++k) {
        const auto exact = 1.0 / std::complex(1.0, 2 * std::numbers::pi * f.values[k] * 1e-3);
        EXPECT_NEAR(std::abs(out.complex_values[k] - exact), 0, 1e-9 * std::abs(exact)) << f.values[k];
        EXPECT_NEAR(ac.column("vdb(out)").values[k], 20 * std::log10(std::abs(exact)), 1e-6);
    }
    const auto tran = circuit.tran("10u", "5m");
    const auto t = tran.column("time"), v = tran.column("v(out)"), difference = tran.column("v(in,out)");
    EXPECT_EQ(t.unit + v.unit + difference.unit, "sVV");
    for (std::size_t k = 1; k < t.values.size(); ++k) EXPECT_NEAR(v.values[k], 1 - std::exp(-t.values[k] / 1e-3), 2e-4);
    // The noise of a low-pass filter is kT/C, at every resistance.
    const auto noise = circuit.noise("v(out)", "v1", "dec", "20", "0.01", "100meg");
    EXPECT_NEAR(noise.measure("onoise_total"), std::sqrt(1.380649e-23 * 300.15 / 1e-6), 3e-10);
    EXPECT_EQ(noise.column("onoise_spectrum").unit, "V/sqrt(Hz)");
    EXPECT_EQ(noise.plots[0].analysis, "noise");
}

TEST(CircuitInterface, AnAnalysisWithoutWordsIsTheNetlistsOwnWithItsMeasurements) {
    const auto circuit = Circuit::from_text(rc);
    const auto tran = circuit.tran();
    ASSERT_EQ(tran.measures.size(), 1u);
    EXPECT_NEAR(tran.measure("tau"), 1e-3, 2e-6);
    EXPECT_NEAR(circuit.ac().measure("corner"), 1e3 / (2 * std::numbers::pi), 0.1);
    EXPECT_EQ(circuit.op().measures.size(), 0u);
    const auto all = circuit.run();
    ASSERT_EQ(all.analyses.size(), 2u);
    EXPECT_EQ(all.plots[0].analysis + all.plots[1].analysis, "actran");
    EXPECT_EQ(all.measures.size(), 2u);
    EXPECT_EQ(all.column("time").values, tran.column("time").values);
    EXPECT_NE(message_of([&] { circuit.dc(); }).find("netlist: the netlist has no .dc; add one, or give the words of .dc SOURCE"),
              std::string::npos);
}

TEST(CircuitInterface, SettingsAndProbesAreThoseOfTheCommandLine) {
    const auto circuit = Circuit::from_text(rc, {{"r=2k", "temp=85"}, {"i(r1)"}});
    EXPECT_NEAR(circuit.tran("10u", "10m").measure("tau"), 2e-3, 4e-6);
    EXPECT_EQ(circuit.op().column("i(r1)").unit, "A");
    const auto noise = circuit.noise("v(out)", "v1", "dec", "20", "0.01", "100meg");
    EXPECT_NEAR(noise.measure("onoise_total"), std::sqrt(1.380649e-23 * 358.15 / 1e-6), 4e-10);
    EXPECT_EQ(Circuit("sa1-circuit").nodes().size(), 82u);
}

TEST(CircuitInterface, StepsAreResultsOfTheirOwn) {
    const std::string text = rc;
    const auto result = Circuit::from_text(text.substr(0, text.find(".end")) + ".step param r list 1k 3k\n").tran();
    ASSERT_EQ(result.steps.size(), 2u);
    EXPECT_EQ(result.steps[1].step, "r=3000");
    EXPECT_TRUE(result.plots.empty());
    EXPECT_NEAR(result.steps[1].measure("tau"), 3e-3, 1e-5);
    EXPECT_EQ(message_of([&] { result.column("v(out)"); }), "'v(out)': the result has 2 steps; take the curve of one: steps[0]");
}

TEST(CircuitInterface, ErrorsNameThePlaceAndTheRemedy) {
    EXPECT_EQ(message_of([] { Circuit("missing.cir"); }), "missing.cir: cannot be read: there is no such file");
    EXPECT_EQ(message_of([] { Circuit::from_text("title\nr1 a 0\n", {}, "x.cir"); }), "x.cir:2:7: r1: its value is missing");
    const auto both = message_of([] { Circuit::from_text("title\nr1 a 0\nr2 b 0\n", {}, "x.cir"); });
    EXPECT_EQ(both, "x.cir:2:7: r1: its value is missing\nx.cir:3:7: r2: its value is missing");
    const auto circuit = Circuit::from_text(rc);
    EXPECT_EQ(message_of([&] { circuit.dc("v9", "0", "1", "0.1"); }),
              "netlist: .dc: 'v9' is not a source, a resistor or temp; did you mean 'v1'?");
    EXPECT_EQ(message_of([&] { circuit.op().column("v(ou)"); }), "there is no curve 'v(ou)'; did you mean 'v(out)'?");
    EXPECT_EQ(message_of([&] { circuit.analyse("tram", {}); }), "netlist: there is no analysis 'tram'; did you mean 'tran'?");
    EXPECT_EQ(message_of([&] { circuit.ac("dec", "10\n.end", "1", "2"); }), "netlist: .ac: the character '\\n' is not allowed here");
    EXPECT_THROW(circuit.ac("dec", "10", "(1", "2"), corpuscle::InputError);
}

TEST(CircuitInterface, WhatDoesNotConvergeIsAnErrorAndAProgressFunctionStops) {
    const std::string text = "a current that no voltage takes\n.param a=4\ni1 0 x 1\nb1 x 0 i={a}*(v(x)*v(x)+0.5)\n.op\n";
    EXPECT_THROW(Circuit::from_text(text).op(), corpuscle::NotConvergedError);
    EXPECT_THROW(Circuit::from_text(text + ".step param a list 4 5\n").op(), corpuscle::NotConvergedError);
    const auto result = Circuit::from_text(text + ".step param a list 1 4 1\n").op();
    EXPECT_NEAR(result.steps.at(0).column("v(x)").values[0], std::sqrt(0.5), 1e-6);
    EXPECT_NE(result.steps.at(1).error.find("no operating point"), std::string::npos);
    EXPECT_EQ(result.warnings.at(0).substr(0, 36), "netlist:5:1: 1 of 3 did not converge");
    double last = -1;
    EXPECT_THROW(Circuit("sa1-circuit").analyse("tran", {}, [&](double fraction) { return last = fraction, fraction < 0.1; }),
                 corpuscle::InterruptedError);
    EXPECT_GE(last, 0.1);
    EXPECT_LT(last, 0.5);
}

}  // namespace
