// Coupled inductors (K): closed forms of transformers and coupled tanks, ngspice, values that change, and lines that are refused.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <complex>
#include <numbers>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/export/ngspice_deck.hpp"
#include "circuit/netlist_runner.hpp"
#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
using Complex = std::complex<double>;

/// A source of 1 V behind r1 = 1 ohm, a transformer, and a load of r2.
struct Transformer {
    double L1 = 10e-3, L2 = 40e-3, k = 0.95, r2 = 1e3;
    std::string text() const {
        return fmt::format("transformer\nv1 in 0 dc 0 ac 1\nr1 in a 1\nk1 l1 l2 {}\nl1 a 0 {}\nl2 b 0 {}\nr2 b 0 {}\n.ac dec 2 10 100k\n",
                           k, L1, L2, r2);
    }
    /// v(b) at f: v(b) = -r2 i2 and r1 i1 + s L1 i1 + s M i2 = 1, r2 i2 + s L2 i2 + s M i1 = 0.
    Complex output(double f) const {
        const Complex s(0, two_pi * f), M = k * std::sqrt(L1 * L2);
        return r2 * s * M / ((1.0 + s * L1) * (r2 + s * L2) - s * s * M * M);
    }
};

TEST(Coupling, TransformersHaveTheirClosedFormFromOpenToShortCircuit) {
    for (const double k : {0.3, 0.95, 1.0, -0.7, -1.0})
        for (const double r2 : {1e-3, 50.0, 1e9}) {
            const Transformer transformer{.k = k, .r2 = r2};
            const auto run = run_netlist(transformer.text());
            const auto f = run.curve("frequency"), re = run.curve("vr(b)"), im = run.curve("vi(b)");
            ASSERT_EQ(f.size(), 9U);
            for (std::size_t n = 0; n < f.size(); ++n) {
                const auto exact = transformer.output(f[n]);
                EXPECT_LT(std::abs(Complex(re[n], im[n]) - exact), 1e-6 * std::abs(exact)) << "k " << k << " r2 " << r2 << " f " << f[n];
            }
        }
}

/// Two equal tanks of 1 mH and 1 uF; the first begins at 1 V. Their sum and their difference oscillate at f / sqrt(1 + k), f / sqrt(1 - k).
TEST(Coupling, CoupledTanksExchangeTheirEnergyAndKeepIt) {
    const double L = 1e-3, C = 1e-6, k = 0.2;
    // The phase error of the trapezoidal rule, which has order 2, is larger.
    for (const auto& [method, error] : {std::pair{"gear", 2e-5}, std::pair{"trap", 1e-4}}) {
        const auto run = run_netlist(fmt::format(
            "tanks\nc1 a 0 1u ic=1\nl1 a 0 1m\nc2 b 0 1u\nl2 b 0 1m\nk1 l1 l2 {}\n.options accuracy=finest method={}\n.tran 1u 2m uic\n", k,
            method));
        const auto t = run.curve("time"), a = run.curve("v(a)"), b = run.curve("v(b)"), i1 = run.curve("i(l1)"), i2 = run.curve("i(l2)");
        ASSERT_GT(t.size(), 100U);
        const double sum = 1 / std::sqrt(L * C * (1 + k)), difference = 1 / std::sqrt(L * C * (1 - k));
        for (std::size_t n = 0; n < t.size(); ++n) {
            ASSERT_NEAR(a[n], (std::cos(sum * t[n]) + std::cos(difference * t[n])) / 2, error) << method << t[n];
            ASSERT_NEAR(b[n], (std::cos(sum * t[n]) - std::cos(difference * t[n])) / 2, error) << method << t[n];
            const double energy = (C * (a[n] * a[n] + b[n] * b[n]) + L * (i1[n] * i1[n] + i2[n] * i2[n])) / 2 + k * L * i1[n] * i2[n];
            ASSERT_NEAR(energy, C / 2, 1e-5 * C) << method << t[n];
        }
    }
}

/// With k = 1, the current of the first coil, 1 A, continues at once in the second, times the ratio of the turns.
TEST(Coupling, AnIdealTransformerKeepsItsFluxWhenItsCurrentChangesWindings) {
    const auto run = run_netlist(
        "flux\nr1 a 0 1meg\nl1 a 0 4m ic=1\nl2 b 0 1m\nr2 b 0 10\nk1 l1 l2 1\n.tran 1u 400u uic\n.meas tran begin find i(l2) at=0\n"
        ".meas tran later find i(l2) at=200u\n.meas tran primary find v(a) at=200u\n");
    EXPECT_NEAR(run.number("begin"), 2, 1e-3);
    EXPECT_NEAR(run.number("later"), 2 * std::exp(-200e-6 * 10 / 1e-3), 1e-3);
    EXPECT_NEAR(run.number("primary"), 2 * -10 * run.number("later"), 1e-2);
}

TEST(Coupling, AnIdealTransformerHasAnOperatingPointAndATransient) {
    const auto run = run_netlist(
        "ideal\nv1 in 0 sin(1 10 1k)\nr1 in a 1\nl1 a 0 10m\nl2 b 0 40m\nr2 b 0 1k\nk1 l1 l2 1\n.op\n.tran 10u 100m\n"
        ".meas tran high max v(b) from=99m\n");
    EXPECT_NEAR(run.curve("i(l1)", "op").back(), 1, 1e-9);
    EXPECT_NEAR(run.number("high"), 10 * std::abs(Transformer{.k = 1}.output(1e3)), 1e-3);
}

/// Open-circuit voltage of the second coil at 1 MHz, where r1 does not matter: k sqrt(L2 / L1).
double ratio(const std::string& lines, const std::string& end = "") {
    return run_netlist("t\nv1 in 0 ac 1\nr1 in a 1m\nr2 b 0 1e9\n" + lines + "\n.ac lin 1 1meg 1meg\n" + end).number("vm(b)");
}

TEST(Coupling, FollowsTheValuesOfItsInductors) {
    EXPECT_NEAR(ratio("l1 a 0 1m\nl2 b 0 4m\nk1 l1 l2 0.5"), 1, 1e-6);
    EXPECT_NEAR(ratio("l1 a 0 1m m=4\nl2 b 0 4m\nk1 l1 l2 0.5"), 2, 1e-6);
    EXPECT_NEAR(ratio("l1 a 0 1m\nl2 b 0 4m tc1=0.01\nk1 l1 l2 0.5", ".temp 127\n"), 0.5 * std::sqrt(8), 1e-6);
    EXPECT_NEAR(ratio("x1 a b tr m=3\n.subckt tr a b\nk1 l1 l2 0.5\nl1 a 0 1m\nl2 b 0 4m\n.ends"), 1, 1e-6);
    EXPECT_NEAR(ratio(".param c=0.25\nl1 a 0 1m\nl2 b 0 4m\nk1 l1 l2 {2*c}"), 1, 1e-6);
    EXPECT_NEAR(ratio("l1 a 0 1m\nl2 b 0 4m\nk1 l1 l2 k=0.5"), 1, 1e-6);
    const auto variants = run_variants(
        "t\n.param l=1m\nv1 in 0 ac 1\nr1 in a 1m\nr2 b 0 1e9\nl1 a 0 1m\nl2 b 0 {l}\nk1 l1 l2 0.5\n"
        ".ac lin 1 1meg 1meg\n.step param l list 4m 16m\n");
    ASSERT_EQ(variants.size(), 2U);
    EXPECT_NEAR(variants[0].number("vm(b)"), 1, 1e-6);
    EXPECT_NEAR(variants[1].number("vm(b)"), 2, 1e-6);
    const auto netlist =
        parse_netlist_text("t\nv1 in 0 ac 1\nr1 in a 1m\nr2 b 0 1e9\nl1 a 0 1m\nl2 b 0 4m\nk1 l1 l2 0.5\n.ac lin 1 1meg 1meg\n");
    ASSERT_TRUE(netlist);
    ResolvedOverrides changes;
    changes.numbers["k1"][""] = 0.25, changes.numbers["l2"][""] = 16e-3;
    EXPECT_NEAR(run_netlist(std::move(*netlist->with_overrides(changes).elaborate())).number("vm(b)"), 1, 1e-6);
}

/// .dc sets the value of an inductor in the device.
TEST(Coupling, FollowsAnInductorThatIsSwept) {
    const auto context = AnalysisContext::make(make_circuit("t\nl1 a 0 1m\nr1 a 0 1\nl2 b 0 4m\nr2 b 0 1\nk1 l1 l2 0.5\n"));
    ASSERT_TRUE(context);
    auto& system = (*context)->system;
    system.device("l2")->set_principal_value(9e-3);
    StampBuffer buffer;
    const double i[] = {2, 3};
    const auto stamp = buffer.eval(*system.device("k1"), i, {});
    EXPECT_NEAR(stamp.capacitance(0, 1), -1.5e-3, 1e-15);
    EXPECT_NEAR(stamp.q[0], -4.5e-3, 1e-15);
    EXPECT_NEAR(stamp.q[1], -3e-3, 1e-15);
}

/// All pairs of one line have its k: three equal coils in series have L (3 + 6 k).
TEST(Coupling, OneLineCouplesAllItsPairs) {
    for (const char* lines : {"k1 l1 l2 l3 0.5\n", "k1 l1 l2 0.5\nk2 l2 l3 0.5\nk3 l1 l3 0.5\n"}) {
        const auto run = run_netlist(fmt::format(
            "series\ni1 0 a ac 1\nl1 a b 1m\nl2 b c 1m\nl3 c 0 1m\nr1 a 0 1e12\nr2 b 0 1e12\nr3 c 0 1e12\n{}.ac lin 1 1k 1k\n", lines));
        EXPECT_NEAR(run.number("vm(a)"), two_pi * 1e3 * 6e-3, 1e-6);
    }
}

std::string error_of(const std::string& body) {
    const auto netlist =
        Netlist::parse("title\n" + body + "\nr1 a 0 1\nr2 b 0 1\nl1 a 0 1m\nl2 b 0 1m\nl3 a c 1m\nr3 c b 1\n.op\n", "t.cir", {});
    if (!netlist) return netlist.error().text();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error().text();
    const auto system = System::make(std::make_shared<const Circuit>(std::move(*circuit)));
    return system ? "" : system.error().text();
}

TEST(Coupling, WrongLinesAreRefusedWithTheirLocation) {
    const struct {
        const char *body, *message;
    } cases[] = {
        {"k1 l1 l2", "t.cir:2:9: k1: its coupling coefficient is missing"},
        {"k1 l1 0.5", "t.cir:2:7: k1: 1 inductor, but expected at least 2: k1 l1 l2 [l3 ...] COEFFICIENT"},
        {"k1 l1 l2 1.5", "t.cir:2:10: k1: k = 1.5 is outside [-1, 1]"},
        {"k1 l1 l2 0.5 0.6", "t.cir:2:14: k1: unexpected '0.6'"},
        {"k1 l1 l4 0.5", "t.cir:2:7: k1: unknown element 'l4'; did you mean 'l1'?"},
        {"k1 l1 r1 0.5", "t.cir:2:7: k1: 'r1' is not an inductor"},
        {"k1 l1 l1 0.5", "t.cir:2:1: k1: l1 is named twice"},
        {"k1 l1 l2 0.5\nk2 l2 l1 0.1", "t.cir:3:1: k2: l2 and l1 are coupled already, by k1; remove one of the two lines"},
        {"k1 l1 l2 0.9\nk2 l2 l3 0.9\nk3 l1 l3 -0.9",
         "t.cir:4:1: k3: k = -0.9 between l1 and l3 does not fit the other couplings of l1, l3, l2: for some currents their energy would "
         "be "
         "negative, because the matrix of the coefficients is not positive definite. Use a smaller magnitude of k"},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of(c.body), c.message) << c.body;
    EXPECT_EQ(error_of("k1 l1 l2 l3 1"), "");
    EXPECT_EQ(error_of("k1 l1 l2 l3 -0.5"), "") << "the smallest k of three coils";
    EXPECT_EQ(error_of("k1 l1 l2 0.5\nv1 a 0 1"), "") << "a loop of a source and a coil, which gets a resistance";
}

/// Exported to ngspice: the same .ac, and the same .tran within its tolerance.
TEST(Coupling, AgreesWithNgspice) {
    const std::string text =
        "coupled\nv1 in 0 dc 0 ac 1 pulse(0 10 10u 1u 1u 100u 250u)\nr1 in a 5\nx1 a b c tr\n.subckt tr a b c\nk1 l1 l2 l3 0.9\n"
        "l1 a 0 1m m=2\nl2 b 0 4m tc1=1m\nl3 c 0 250u\n.ends\nr2 b 0 100\nr3 c 0 30\n.options temp=50\n";
    const TemporaryFolder folder;
    const auto run_both = [&](const std::string& analysis) {
        const auto here = run_netlist(text + analysis);
        auto deck = ngspice_deck(make_circuit(text + analysis));
        EXPECT_TRUE(deck) << (deck ? "" : deck.error().text());
        folder.write("deck.cir", deck ? deck->text : "");
        const auto log = run_ngspice(folder / "deck.cir", analysis.starts_with(".ac") ? folder / "deck.raw" : std::string());
        return std::pair(here, log);
    };
    const auto [here, log] = run_both(".ac dec 5 100 1meg\n");
    if (log.find("ngspice: not found") != std::string::npos) GTEST_SKIP() << "ngspice is not installed";
    const auto reference = read_raw_file(folder / "deck.raw");
    ASSERT_EQ(reference.size(), 1U) << log;
    for (const char* name : {"v(b)", "v(c)"}) {
        const auto values = here.complex_curve(name);
        const auto* other = reference[0].find_curve(name);
        ASSERT_TRUE(other && other->values.size() == values.size()) << name;
        for (std::size_t k = 0; k < values.size(); ++k)
            EXPECT_LT(std::abs(values[k] - other->values[k]), 1e-6 * std::abs(values[k])) << name << k;
    }
    const auto [tran, tran_log] =
        run_both(".tran 0.1u 500u 0 0.1u\n.meas tran bb find v(b) at=150u\n.meas tran cc find v(c) at=400u\n.meas tran high max v(b)\n");
    for (const char* name : {"bb", "cc", "high"}) EXPECT_NEAR(tran.number(name), logged_number(tran_log, name), 3e-3) << name << tran_log;
}

}  // namespace
}  // namespace corpuscle::circuit::test
