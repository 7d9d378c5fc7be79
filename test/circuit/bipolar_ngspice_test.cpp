// Circuits of bipolar transistors with complete cards, in Debian's ngspice and in Corpuscle.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>

#include "circuit/bipolar/bipolar_cards.hpp"
#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

bool has_ngspice() {
    static const bool found = std::system("ngspice --version >/dev/null 2>&1") == 0;
    return found;
}

/// The plots of a deck in ngspice.
std::vector<Plot> reference_plots(const TemporaryFolder& folder, const std::string& deck) {
    const auto log = run_ngspice(folder.write("deck.cir", deck), folder / "deck.raw");
    auto plots = read_raw_file(folder / "deck.raw");
    EXPECT_FALSE(plots.empty()) << log << deck;
    return plots;
}

/// Tolerances of a comparison: relative, and relative to the largest value of the curve.
struct Closeness {
    double relative, of_largest;
};

/// Compares the curves that are in both plots. ngspice's kT/q is smaller than the SI value by 3.4e-7 of it. At v = 0.9 V and -40 C this
/// changes the current of a junction by v q/kT 3.4e-7 = 1.5e-5 of it, and the voltage of a junction with a given current by 0.3 uV. The
/// substrate's current is left out: ngspice multiplies gmin by m.
void compare_curves(const Plot& result, const Plot& reference, const Closeness& tolerance) {
    ASSERT_EQ(result.point_count(), reference.point_count()) << result.name;
    int compared = 0;
    for (const auto& c : reference.curves) {
        const auto* other = result.find_curve(corpuscle_name(c.name));
        if (other == nullptr || c.type == "frequency" || other->name == "i(vs)") continue;
        if (other->name == "inoise_total") continue;  // ngspice's is wrong where the gain falls
        ++compared;
        double largest = 0;
        for (const auto& x : c.values) largest = std::max(largest, std::abs(x));
        for (std::size_t k = 0; k < c.values.size(); ++k)
            ASSERT_LE(std::abs(other->values[k] - c.values[k]),
                      tolerance.relative * std::abs(c.values[k]) + tolerance.of_largest * largest + (c.type == "current" ? 2e-14 : 0))
                << c.name << " at point " << k << ": Corpuscle " << other->values[k] << ", ngspice " << c.values[k];
    }
    EXPECT_GE(compared, 1) << result.name;
}

/// Runs a deck in both simulators and compares all plots.
void compare_deck(const std::string& deck, const Closeness& tolerance) {
    SCOPED_TRACE(deck);
    const TemporaryFolder folder;
    auto reference = reference_plots(folder, deck);
    const auto result = run_corpuscle(folder / "deck.cir").plots();
    ASSERT_FALSE(result.empty());
    for (const auto& plot : result) {
        const auto match = std::ranges::find(reference, plot.name, &Plot::name);
        ASSERT_NE(match, reference.end()) << plot.name;
        compare_curves(plot, *match, tolerance);
        reference.erase(match);
    }
}

constexpr std::string_view tight = ".options reltol=1e-9 abstol=1e-16 vntol=1e-11 gmin=1e-15 itl1=500 itl2=500\n";

class BipolarCards : public testing::TestWithParam<std::string> {
protected:
    std::string card() const { return bipolar_card(GetParam()); }
    double sign() const { return card().starts_with("pnp") ? -1 : 1; }
    /// One transistor with a source at each terminal, at the temperature in C; `vb` and `vc`: names of the nodes of the sources.
    std::string transistor(double celsius, std::string_view vc = "c", std::string_view vb = "b") const {
        return fmt::format("{}\n{}.temp {}\nvc {} 0 {}\nvb {} 0 {} ac 1\nve e 0 0\nvs s 0 -3\nq1 c b e s m m=3\n.model m {}\n", GetParam(),
                           tight, celsius, vc, 3 * sign(), vb, 0.65 * sign(), card());
    }
    void SetUp() override {
        if (!has_ngspice()) GTEST_SKIP() << "ngspice is not installed";
    }
};

constexpr double temperatures[] = {-40, 27, 125};

TEST_P(BipolarCards, HaveTheSameGummelPlot) {
    for (const double celsius : temperatures)
        compare_deck(transistor(celsius) + fmt::format(".dc vb {} {} {}\n.end\n", -1 * sign(), 0.95 * sign(), 0.05 * sign()), {3e-5, 2e-6});
}

TEST_P(BipolarCards, HaveTheSameOutputCurves) {  // from the reverse region through saturation
    for (const double celsius : temperatures)
        compare_deck(transistor(celsius) + fmt::format(".dc vc {0} {1} {2} vb {3} {4} {2}\n.end\n", -0.5 * sign(), 5 * sign(), 0.1 * sign(),
                                                       0.5 * sign(), 0.8 * sign()),
                     {5e-5, 1e-5});
}

/// The text without its parameter rbm, so that the base resistance is constant.
std::string with_constant_base_resistance(std::string deck) {
    const auto at = deck.find(" rbm=");
    return at == std::string::npos ? deck : deck.erase(at, deck.find(' ', at + 1) - at);
}

TEST_P(BipolarCards, HaveTheSameSmallSignalsAndNoise) {
    // ngspice's .ac leaves out the dependence of the base resistance on the voltages, so the resistance is constant here. That Corpuscle's
    // is right is a test of bipolar_test.cpp.
    for (const double celsius : temperatures)
        compare_deck(with_constant_base_resistance(transistor(celsius, "cc", "bb")) +
                         "rb bb b 1k\nrc cc c 100\n.op\n.ac dec 5 1k 10g\n.noise v(c) vb dec 5 1 1g\n.end\n",
                     {5e-5, 1e-6});
}

INSTANTIATE_TEST_SUITE_P(Ngspice, BipolarCards, testing::Values("n2222", "n3904", "n3906", "bc847", "complete", "mirrored"),
                         [](const auto& one) { return one.param; });

class BipolarCircuits : public testing::Test {
protected:
    void SetUp() override {
        if (!has_ngspice()) GTEST_SKIP() << "ngspice is not installed";
    }
    static std::string models() { return ".model n " + bipolar_card("n2222") + "\n.model p " + bipolar_card("n3906") + "\n"; }
};

TEST_F(BipolarCircuits, HaveTheSameOperatingPoints) {
    const std::string circuits[] = {
        "differential pair with a mirror\nvp vp 0 5\nvn vn 0 -5\nvin a 0 1m\nq1 c a t n\nq2 out 0 t n\nq3 c c vp p\nq4 out c vp p\n"
        "rt d vn 4.3k\nq5 t r vn n\nq6 r r vn n\nrr vp r 9.1k\nrd t d 1meg\nrl out 0 1meg\n.op\n.dc vin -20m 20m 2m\n",
        "class AB with a multiplier of the junction voltage\nvp vp 0 12\nvn vn 0 -12\nvin in 0 0\nq1 vp b1 e1 n m=4\nq2 vn b2 e2 p m=4\n"
        "re1 e1 out 1\nre2 e2 out 1\nrl out 0 8\nq3 b1 m b2 n\nra b1 m 2k\nrb m b2 1k\nrs vp b1 1k\nq4 b2 in2 ee n\nree ee vn 100\n"
        "vb in2 vn 1.3\nrin in out 1meg\n.op\n.dc vb 0.9 1.8 0.05\n",
        "Darlington pair, and a Wilson mirror\nvp vp 0 10\nvin a 0 1.35\nq1 c a b n\nq2 c b 0 n\nrc vp c 1k\nrb b 0 10k\nq3 x y vp p\nq4 y "
        "y vp p\n"
        "q5 z x y p\nrx x 0 8k\nrz z 0 1k\n.op\n.dc vin 0.5 1.6 0.05\n",
        "temperature of single transistors\nvp vp 0 5\nr1 vp a 10k\nq1 a a 0 n temp=-20\nr2 vp b 10k\nq2 b b 0 n dtemp=60 m=2\nr3 d 0 "
        "10k\nq3 d d "
        "vp p temp=110\n.op\n"};
    for (const auto& circuit : circuits)
        for (const double celsius : temperatures)
            compare_deck(circuit + models() + std::string(tight) + fmt::format(".temp {}\n.end\n", celsius),
                         {5e-5, 1e-6});  // two junctions in series
}

TEST_F(BipolarCircuits, HaveTheSameResponseInAnOperationalAmplifier) {
    for (const double celsius : temperatures)
        compare_deck("a 741\nvcc vcc 0 15\nvee vee 0 -15\nvin inp 0 0.5 ac 1\n.include " + source_root() +
                         "/test/circuit/bipolar/ua741.inc\n" + std::string(tight) +
                         fmt::format(".temp {}\n.op\n.dc vin -10 10 1\n.ac dec 5 1 10meg\n.end\n", celsius),
                     {5e-5, 1e-6});
}

/// The times at which a curve crosses a level upwards, in a transient.
std::vector<double> upward_crossings(const Plot& plot, const std::string& curve, double level) {
    const auto& t = plot.curves[0].values;
    const auto& v = plot.find_curve(curve)->values;
    std::vector<double> out;
    for (std::size_t k = 1; k < v.size(); ++k)
        if (v[k - 1].real() < level && v[k].real() >= level)
            out.push_back(t[k - 1].real() + (level - v[k - 1].real()) / (v[k].real() - v[k - 1].real()) * (t[k].real() - t[k - 1].real()));
    return out;
}

/// Compares the last four upward crossings of v(out), with a tolerance in seconds, in a transient of both simulators.
void compare_crossings(const std::string& deck, const std::string& curve, double level, std::size_t least, double tolerance) {
    SCOPED_TRACE(deck);
    const TemporaryFolder folder;
    const auto reference = reference_plots(folder, deck);
    ASSERT_EQ(reference.size(), 1U);
    const auto result = run_corpuscle(folder / "deck.cir").plots();
    ASSERT_EQ(result.size(), 1U);
    const auto ours = upward_crossings(result[0], curve, level), theirs = upward_crossings(reference[0], curve, level);
    ASSERT_EQ(ours.size(), theirs.size());
    ASSERT_GE(ours.size(), least);
    for (std::size_t k = 0; k < ours.size(); ++k) EXPECT_NEAR(ours[k], theirs[k], tolerance) << "crossing " << k;
}

constexpr std::string_view accurate = ".options reltol=1e-5 abstol=1e-12 vntol=1e-7\n";

TEST_F(BipolarCircuits, HaveTheSameStorageTimeInAnInverter) {
    for (const double celsius : temperatures) {
        const auto deck =
            "inverter in saturation\nvcc vcc 0 5\nvin in 0 pulse(0 5 100n 10n 10n 1u 2u)\nrb in b 10k\ncb in b 20p\nrc vcc out 1k\n"
            "q1 out b 0 n\ncl out 0 10p\n" +
            models() + std::string(accurate) + fmt::format(".temp {}\n.tran 1n 6u 0 2n\n.end\n", celsius);
        compare_crossings(deck, "v(out)", 2.5, 3, 1e-9);  // of a storage time of some 150 ns
    }
}

TEST_F(BipolarCircuits, HaveTheSamePeriodInAMultivibrator) {
    compare_crossings(
        "astable multivibrator\nvcc vcc 0 pulse(0 5 0 1u 1u 1 2)\nr1 vcc c1 1k\nr2 vcc b2 47k\nr3 vcc b1 40k\nr4 vcc c2 1k\nca c1 b2 "
        "1n\ncb c2 b1 1n\n"
        "q1 c1 b1 0 n\nq2 c2 b2 0 n\n" +
            models() + std::string(accurate) + ".tran 50n 300u 0 50n\n.end\n",
        "v(c1)", 2.5, 4, 30e-9);  // of 260 us
}

TEST_F(BipolarCircuits, HaveTheSamePeriodInARing) {
    compare_crossings(
        "ring of three inverters\nvcc vcc 0 pulse(0 5 0 10n 10n 1 2)\nr1 vcc a 1k\nr2 vcc b 1k\nr3 vcc c 1k\nra a ab 4.7k\nrb b bb "
        "4.7k\nrc c cb 4.7k\n"
        "q1 b ab 0 n\nq2 c bb 0 n\nq3 a cb 0 n\nca a 0 10p\n" +
            models() + std::string(accurate) + ".tran 1n 5u 0 1n\n.end\n",
        "v(a)", 2.5, 4, 1e-9);  // of 4 us
}

}  // namespace
}  // namespace corpuscle::circuit::test
