// .pz: poles and zeros with closed forms, from ngspice, and against .ac. Some circuits have singular matrices.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <numbers>

#include "circuit/netlist_runner.hpp"
#include "circuit/solve/pencil.hpp"
#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;
constexpr double pi = std::numbers::pi;

const AnalysisResult& pz_of(const NetlistRun& run) {
    const auto found = std::ranges::find_if(run.analyses(), [](const AnalysisRun& a) { return a.directive->name == "pz"; });
    return found->result;
}

/// Expects that the roots are those expected, in any order, within a relative tolerance.
void expect_roots(const Roots& actual, Roots expected, double tolerance, const std::string& what) {
    ASSERT_EQ(actual.size(), expected.size()) << what;
    for (const auto& s : actual) {
        const auto near = std::ranges::min_element(expected, {}, [&](const Complex& e) { return std::abs(e - s); });
        EXPECT_LE(std::abs(*near - s), tolerance * std::abs(s)) << what << ": " << s << " is not " << *near;
        expected.erase(near);
    }
}

/// n sections of a resistor in series and a capacitor to ground, driven by a voltage.
std::string ladder(int sections) {
    std::string out = "ladder\nv1 n0 0 dc 0 ac 1\n";
    for (int k = 0; k < sections; ++k) out += fmt::format("r{0} n{0} n{1} 1k\nc{0} n{1} 0 1n\n", k, k + 1);
    return out;
}

// The poles of a ladder of n equal sections are -4/(RC) sin^2((2k-1) pi / (4n+2)).
TEST(PoleZero, OfAnRcLadderHasTheClosedForm) {
    for (const int n : {1, 2, 7, 40}) {
        const auto run = run_netlist(ladder(n) + fmt::format(".pz n0 0 n{} 0 vol pz\n", n));
        Roots expected;
        for (int k = 1; k <= n; ++k) expected.emplace_back(-4e6 * std::pow(std::sin((2 * k - 1) * pi / (4 * n + 2)), 2));
        expect_roots(*pz_of(run).poles, expected, 1e-9, fmt::format("{} sections", n));
        EXPECT_EQ(pz_of(run).zeros->size(), 0U);
        EXPECT_EQ(run.number("poles"), n);
        EXPECT_NEAR(run.number("slowest_pole"), std::abs(expected[0]) / (2 * pi), 1e-6 * std::abs(expected[0]));
    }
}

TEST(PoleZero, OfAResonatorHasTheClosedForm) {
    const auto run = run_netlist("rlc\nv1 a 0 dc 0 ac 1\nr1 a b 10\nl1 b c 1m\nc1 c 0 1n\n.pz a 0 c 0 vol pz\n");
    const double damping = 10 / 2e-3, w0 = 1e6, imaginary = std::sqrt(w0 * w0 - damping * damping);
    expect_roots(*pz_of(run).poles, {{-damping, imaginary}, {-damping, -imaginary}}, 1e-10, "RLC");
    EXPECT_NEAR(quality_of((*pz_of(run).poles)[0]), 100, 1e-6);
    // The impedance that a current sees: a zero where R + sL = 0.
    const auto impedance = run_netlist("rlc\ni1 0 c dc 0\nr1 a c 10\nl1 a 0 1m\nc1 c 0 1n\n.pz c 0 c 0 cur pz\n");
    expect_roots(*pz_of(impedance).poles, {{-damping, imaginary}, {-damping, -imaginary}}, 1e-10, "RLC");
    expect_roots(*pz_of(impedance).zeros, {-1e4}, 1e-12, "RLC");
}

// With equal resistors R and the capacitors C1 (feedback) and C2: w0^2 = 1/(R^2 C1 C2), Q = sqrt(C1/C2)/2.
TEST(PoleZero, OfASallenKeyFilterHasTheClosedForm) {
    const std::string filter = "sallen-key\nvin in 0 dc 0 ac 1\nr1 in a 1k\nr2 a b 1k\nc1 a out 90n\nc2 b 0 10n\ne1 out 0 b 0 1\n";
    for (const std::string line : {".pz in 0 out 0 vol pz\n", ".pz v(out) vin\n"}) {
        const auto run = run_netlist(filter + line);
        const auto& poles = *pz_of(run).poles;
        ASSERT_EQ(poles.size(), 2U) << line;
        EXPECT_NEAR(std::abs(poles[0]), 1 / (1e3 * std::sqrt(90e-9 * 10e-9)), 1e-4);
        EXPECT_NEAR(quality_of(poles[0]), 1.5, 1e-9);
        EXPECT_EQ(pz_of(run).zeros->size(), 0U);
        EXPECT_EQ(run.number("unstable_poles"), 0);
    }
    const auto oscillator = run_netlist(
        "gain 4\nvin in 0 dc 0\nr1 in a 1k\nr2 a b 1k\nc1 a out 10n\nc2 b 0 10n\ne1 out 0 b 0 4\n"
        ".pz in 0 out 0 vol pol\n.expect unstable_poles 2 0\n");
    EXPECT_EQ(oscillator.number("unstable_poles"), 2);
    EXPECT_FALSE(pz_of(oscillator).zeros);
}

// Equal buffered stages have a multiple pole; capacitors in a loop with a source, and the gain of an ideal amplifier, have eigenvalues at
// infinity.
TEST(PoleZero, OfSingularMatricesAreFinite) {
    const auto stages = run_netlist(
        "stages\nv1 a 0 dc 0\nr1 a b 1k\nc1 b 0 1n\ne1 c 0 b 0 1\nr2 c d 1k\nc2 d 0 1n\ne2 f 0 d 0 1\nr3 f g 1k\n"
        "c3 g 0 1n\n.pz a 0 g 0 vol pz\n");
    expect_roots(*pz_of(stages).poles, {-1e6, -1e6, -1e6}, 1e-4, "equal stages");
    const auto loop = run_netlist("loop\nv1 a 0 dc 0\nc1 a 0 1n\nc2 a b 1n\nc3 b 0 1n\nr1 b 0 1k\n.pz a 0 b 0 vol pz\n");
    expect_roots(*pz_of(loop).poles, {-5e5}, 1e-12, "loop of capacitors and a source");
    expect_roots(*pz_of(loop).zeros, {0}, 0, "loop of capacitors and a source");
    const auto differentiator =
        run_netlist("ideal amplifier\nv1 a 0 dc 0\nc1 a m 1n\nr1 m out 1k\ne1 out 0 0 m 1e12\n.pz a 0 out 0 vol pz\n");
    expect_roots(*pz_of(differentiator).zeros, {0}, 0, "differentiator");
    expect_roots(*pz_of(differentiator).poles, {-1e18}, 1e-6, "differentiator");  // (1 + gain) / RC
    const auto nothing = run_netlist("no path\nv1 a 0 dc 0\nr1 a 0 1k\nv2 b 0 1\nr2 b c 1k\nc2 c 0 1n\n.pz a 0 c 0 vol pz\n");
    EXPECT_FALSE(pz_of(nothing).zeros);
    expect_roots(*pz_of(nothing).poles, {-1e6}, 1e-12, "no path");
    ASSERT_EQ(nothing.warnings().size(), 1U);
    EXPECT_NE(nothing.warnings()[0].text().find("the output does not depend on the input"), std::string::npos);
}

TEST(PoleZero, AreFoundOverTwentyFourDecades) {
    const auto run = run_netlist("wide\nv1 a 0 dc 0\nr1 a b 1\nc1 b 0 1f\ne1 c 0 b 0 1\nr2 c d 1t\nc2 d 0 1\n.pz a 0 d 0 vol pz\n");
    expect_roots(*pz_of(run).poles, {-1e-12, -1e15}, 1e-9, "two poles");
}

const std::string followed_diode =
    "diode\nv1 a 0 dc 1 ac 1\nr1 a b 1k\nd1 b 0 dm\nc1 b c 1n\nl1 c d 1u\nr2 d 0 10k\nr3 c 0 3k\n"
    ".model dm d(is=1e-14 cjo=2p tt=10n)\n";

/// H(s) = H(s_0) prod (s - z) / (s_0 - z) prod (s_0 - p) / (s - p)
TEST(PoleZero, GiveTheResponseOfAc) {
    const auto run = run_netlist(followed_diode + ".ac dec 5 1k 10g\n.pz a 0 d 0 vol pz\n");
    const auto h = run.complex_curve("v(d)", "ac");
    const auto f = run.curve("frequency", "ac");
    const auto product = [&](double frequency) {
        Complex out = 1;
        const Complex s(0, 2 * pi * frequency);
        for (const auto& z : *pz_of(run).zeros) out *= (s - z) / 1e6;
        for (const auto& p : *pz_of(run).poles) out /= (s - p) / 1e6;
        return out;
    };
    for (std::size_t k = 0; k < f.size(); ++k)
        EXPECT_LE(std::abs(h[k] / h[0] - product(f[k]) / product(f[0])), 1e-7 * std::abs(h[k] / h[0])) << f[k] << " Hz";
}

// The high-pass filters B and C of the thesis, whose cutoff frequencies circuits/high_pass.cir finds from .ac: 19.04 and 2.063 Hz.
TEST(PoleZero, OfTheThesissFiltersAreTheirCutoffFrequencies) {
    auto circuit = *Netlist::read(corpuscle::test::source_root() + "/circuits/high_pass.cir")->elaborate();
    std::erase_if(circuit.directives, [](const Directive& d) { return d.name == "expect" || d.name == "meas" || d.name == "ac"; });
    circuit.directives.push_back({"pz", {"vf", "0", "hpb", "0", "vol", "pz"}, {}, {}});
    const auto run = run_netlist(std::move(circuit));
    const auto& poles = *pz_of(run).poles;
    EXPECT_NEAR(std::abs(poles[0]) / (2 * pi), 2.063, 2e-3);
    EXPECT_NEAR(std::abs(poles[1]) / (2 * pi), 19.04, 2e-2);
    EXPECT_EQ((*pz_of(run).zeros)[0], 0.0);
    EXPECT_EQ(run.number("unstable_poles"), 0);
}

TEST(PoleZero, AgreeWithNgspice) {
    const TemporaryFolder folder;
    const std::string notch =
        "notch\nv1 a 0 dc 0 ac 1\nr1 a b 1k\nr2 b c 1k\nc3 b 0 200n\nc1 a d 100n\nc2 d c 100n\nr3 d 0 470\nrl c 0 100k\n";
    for (const auto& [circuit, line] :
         {std::pair{notch, "pz a 0 c 0 vol pz"}, std::pair{followed_diode, "pz a 0 d 0 vol pz"},
          std::pair{std::string("bridge\ni1 0 a dc 0 ac 1\nr1 a 0 1k\nc1 a b 1n\nr2 b 0 2k\nl1 a c 10m\nr3 c 0 3k\nc3 c b 2n\n"),
                    "pz a 0 b c cur pz"}}) {
        const auto log =
            run_ngspice(folder.write("x.cir", circuit + ".control\n" + line + "\nset numdgt=12\nprint all\n.endc\n.end\n"), "");
        const auto run = run_netlist(circuit + "." + line + "\n");
        for (const auto& [name, roots] : {std::pair{"pole", *pz_of(run).poles}, std::pair{"zero", *pz_of(run).zeros}}) {
            Roots theirs;
            for (int k = 1;; ++k) {
                const auto key = fmt::format("{}({}) = ", name, k);
                const auto at = log.find(key);
                if (at == std::string::npos) break;
                Complex s;
                char* end = nullptr;
                s.real(std::strtod(log.c_str() + at + key.size(), &end));
                s.imag(std::strtod(end + 1, nullptr));
                theirs.push_back(s);
            }
            expect_roots(roots, theirs, 1e-6, circuit + name + "\n" + log);
        }
    }
}

TEST(PoleZero, ReportErrorsWithTheirLocation) {
    const auto error_of = [](const std::string& line) {
        const auto netlist = parse_netlist_text("t\nv1 in 0 1\nr1 in out 1k\nc1 out 0 1n\n" + line + "\n");
        const auto outcome = run_directives(std::make_shared<const Circuit>(*netlist->elaborate()));
        const auto text = outcome ? "nothing" : outcome.error().text();
        return text.substr(text.find("test.cir") == std::string::npos ? 0 : text.find("test.cir") + 9);
    };
    EXPECT_EQ(error_of(".pz in 0 aut 0 vol pz"), "5:10: .pz: unknown node 'aut'; did you mean 'out'?");
    EXPECT_EQ(error_of(".pz in 0 out 0 vol all"),
              "5:20: .pz: 'all' must be pol, zer or pz; expected .pz IN+ IN- OUT+ OUT- vol|cur pol|zer|pz");
    EXPECT_EQ(error_of(".pz in 0 out 0 volt pz"),
              "5:16: .pz: 'volt' must be vol or cur; expected .pz IN+ IN- OUT+ OUT- vol|cur pol|zer|pz");
    EXPECT_EQ(error_of(".pz in in out 0 vol pz"), "5:5: .pz: the two nodes of a port must differ");
    EXPECT_EQ(error_of(".pz in 0 out 0"), "5:1: .pz: 4 words; expected .pz IN+ IN- OUT+ OUT- vol|cur pol|zer|pz");
    EXPECT_EQ(error_of(".pz v(out) r1"), "5:1: .pz: 'r1' is not an independent source");
    const auto large = parse_netlist_text(ladder(600) + ".pz n0 0 n600 0 vol pz\n");
    EXPECT_NE(run_directives(std::make_shared<const Circuit>(*large->elaborate())).error().text().find("the limit is 499"),
              std::string::npos);
}

}  // namespace
}  // namespace corpuscle::circuit::test
