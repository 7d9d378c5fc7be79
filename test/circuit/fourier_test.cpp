// .four: harmonics of waveforms with closed forms, and of the same netlist in ngspice.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "circuit/netlist_runner.hpp"
#include "support/ngspice.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit::test {
namespace {

const std::vector<FourierSpectrum>& spectra_of(const NetlistRun& run) { return run.analyses().at(0).spectra; }

// Odd harmonics 4/(pi k) in phase, no even ones. The edges take 1e-6 of the period.
TEST(Fourier, OfASquareWaveHasItsClosedForm) {
    const auto run = run_netlist(
        "square\nv1 a 0 pulse(-1 1 0 1n 1n 0.499999m 1m)\nr1 a 0 1k\n.tran 1u 3m\n.four 1k v(a)\n"
        ".expect thd(v(a)) 42.88 0.1%\n");
    const auto& spectrum = spectra_of(run).at(0);
    ASSERT_EQ(spectrum.harmonics.size(), 9U);
    EXPECT_NEAR(spectrum.mean, 0, 1e-9);
    double squares = 0;
    for (std::size_t k = 1; k <= 9; ++k) {
        const auto& h = spectrum.harmonics[k - 1];
        const double expected = k % 2 == 1 ? 4 / (std::numbers::pi * static_cast<double>(k)) : 0;
        EXPECT_DOUBLE_EQ(h.frequency, 1e3 * static_cast<double>(k));
        EXPECT_NEAR(h.magnitude, expected, 1e-7) << k;
        if (k % 2 == 1) {
            EXPECT_NEAR(h.phase, 0, 0.002) << k;
        }
        if (k > 1) squares += expected * expected;
    }
    EXPECT_NEAR(run.number("thd(v(a))"), 100 * std::sqrt(squares) / (4 / std::numbers::pi), 1e-5);
    EXPECT_TRUE(run.expectations().at(0).is_met);
}

TEST(Fourier, OfASineHasOneHarmonic) {
    const auto run = run_netlist(
        "sine\nv1 a 0 sin(0.5 2 1k 0 0 30)\nr1 a 0 1k\n.options reltol=1e-7 vntol=1n\n.tran 1u 2.5m\n"
        ".four 1k v(a) {v(a)*v(a)}\n.four 500 v(a)\n");
    const auto& sine = spectra_of(run).at(0);
    EXPECT_NEAR(sine.mean, 0.5, 1e-6);
    EXPECT_NEAR(sine.harmonics[0].magnitude, 2, 1e-5);
    EXPECT_NEAR(sine.harmonics[0].phase, 30 + 180 - 360, 1e-3) << "the last period begins at 1.5 ms";
    EXPECT_LT(sine.distortion(), 1e-3);
    // (0.5 + 2 sin x)^2 = 2.25 + 2 sin x - 2 cos 2x
    const auto& square = spectra_of(run).at(1);
    EXPECT_NEAR(square.mean, 2.25, 1e-4);
    EXPECT_NEAR(square.harmonics[0].magnitude, 2, 1e-4);
    EXPECT_NEAR(square.harmonics[1].magnitude, 2, 1e-3);
    EXPECT_NEAR(square.distortion(), 100, 0.05);
    const auto& octave = spectra_of(run).at(2);
    EXPECT_NEAR(octave.harmonics[0].magnitude, 0, 1e-5);
    EXPECT_NEAR(octave.harmonics[1].magnitude, 2, 1e-5);
}

/// A straight line between points is integrated exactly, so more points on it change nothing.
TEST(Fourier, DoesNotDependOnThePointsOfStraightLines) {
    const auto run = run_netlist("saw\nv1 a 0 pwl(0 0 1m 1 1.000001m 0 2m 1)\nr1 a 0 1k\n.tran 1u 2m\n.four 1k v(a)\n");
    for (std::size_t k = 1; k <= 9; ++k)
        EXPECT_NEAR(spectra_of(run).at(0).harmonics[k - 1].magnitude, 1 / (std::numbers::pi * static_cast<double>(k)), 1e-6) << k;
}

TEST(Fourier, AgreesWithNgspice) {
    const TemporaryFolder folder;
    const std::string deck = folder.write("x.cir",
                                          "clipped sine\n.options reltol=1e-6\nv1 in 0 sin(0.2 1 1k)\nr1 in out 1k\nd1 out 0 dm\n"
                                          ".model dm d(is=1e-14)\nc1 out 0 10n\n.tran 0.5u 5m 0 0.5u\n.four 1k v(out) v(in)\n.end\n");
    const auto log = run_ngspice(deck, "");
    const auto outcome = run_corpuscle(deck);
    const auto& spectrum = outcome.analyses.at(0).spectra.at(0);
    auto at = log.find("Fourier analysis for v(out)");
    ASSERT_NE(at, std::string::npos) << log;
    const auto thd = log.find("THD: ", at);
    ASSERT_NE(thd, std::string::npos) << log;
    EXPECT_NEAR(std::strtod(log.c_str() + thd + 5, nullptr), spectrum.distortion(), 2e-3 * spectrum.distortion());
    for (std::size_t k = 0; k <= 9; ++k) {  // " 1 1000 0.6 -12.3 1 0"
        const auto line = log.find(fmt::format("\n {} ", k), at);
        ASSERT_NE(line, std::string::npos) << log;
        std::istringstream fields(log.substr(line + 1, 200));
        double number = 0, frequency = 0, magnitude = 0, phase = 0;
        fields >> number >> frequency >> magnitude >> phase;
        if (k == 0) {
            EXPECT_NEAR(magnitude, spectrum.mean, 1e-4) << log;
            continue;
        }
        EXPECT_NEAR(magnitude, spectrum.harmonics[k - 1].magnitude, 1e-4) << log;
        if (magnitude > 0.01) {
            EXPECT_NEAR(phase, spectrum.harmonics[k - 1].phase, 0.2) << log;
        }
    }
}

TEST(Fourier, AndPolesAreInTheJsonDocument) {
    const TemporaryFolder folder;
    folder.write("x.cir",
                 "t\nv1 a 0 sin(0 2 1k)\nr1 a b 1k\nl1 b c 1m\nc1 c 0 1n\n.pz a 0 c 0 vol pz\n.control\ntran 1u 2m\nfourier 1k v(a)\n"
                 ".endc\n.end\n");
    const auto document = nlohmann::json::parse(run_program(folder, "run x.cir --json").out);
    const auto& fourier = document["analyses"][1]["fourier"][0];
    EXPECT_EQ(fourier["curve"], "v(a)");
    EXPECT_NEAR(fourier["harmonics"][0]["magnitude"].get<double>(), 2, 1e-3);
    EXPECT_NEAR(document["numbers"]["thd(v(a))"].get<double>(), 0, 0.01);
    const auto& poles = document["analyses"][0]["poles"];
    ASSERT_EQ(poles.size(), 2U);
    EXPECT_NEAR(poles[0]["q"].get<double>(), 1, 1e-9);
    EXPECT_NEAR(poles[0]["frequency"].get<double>(), 1e6 / (2 * std::numbers::pi), 1e-3);
    EXPECT_NEAR(poles[0]["real"].get<double>(), -5e5, 1e-3);
    const auto text = run_program(folder, "run x.cir").out;
    EXPECT_NE(text.find("Fourier analysis of v(a)"), std::string::npos) << text;
}

TEST(Fourier, ReportsErrorsBeforeTheTransientRuns) {
    const auto outcome_of = [](const std::string& line) {
        const auto netlist = parse_netlist_text("t\nv1 in 0 sin(0 1 1meg)\nr1 in out 1k\nc1 out 0 1n\n" + line + "\n");
        return run_directives(std::make_shared<const Circuit>(*netlist->elaborate()));
    };
    const auto error_of = [&](const std::string& line) {
        const auto outcome = outcome_of(line);
        const auto text = outcome ? "nothing" : outcome.error().text();
        return text.substr(text.find("test.cir") == std::string::npos ? 0 : text.find("test.cir") + 9);
    };
    EXPECT_EQ(error_of(".tran 1n 1000\n.four 1meg v(aut)"), "6:12: .four: there is no curve 'v(aut)'; did you mean 'v(out)'?");
    EXPECT_EQ(error_of(".tran 1n 1000\n.four 1u v(out)"),
              "6:7: .four: the period of 1e-06 Hz, 1e+06 s, is longer than the 1000 s of the .tran");
    EXPECT_EQ(error_of(".tran 1n 1000\n.four 0 v(out)"), "6:7: .four: the frequency 0 Hz must be above 0");
    EXPECT_EQ(error_of(".tran 1n 1000\n.four 1meg"), "6:1: .four: expected .four FREQUENCY v(NODE) ...");
    EXPECT_EQ(error_of(".op\n.four 1meg v(out)"), "6:1: .four: the netlist has no .tran");
    const auto partly = outcome_of(".tran 1n 2u\n.four 1meg i(c1) v(out)");
    ASSERT_TRUE(partly) << partly.error().text();
    ASSERT_EQ(partly->left_out.size(), 1U);
    EXPECT_NE(partly->left_out[0].text().find("6:12: .four i(c1) is left out: i(c1) is not available in .tran"), std::string::npos);
    EXPECT_EQ(partly->analyses[0].spectra.size(), 1U);
}

}  // namespace
}  // namespace corpuscle::circuit::test
