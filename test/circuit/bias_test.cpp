// The bias generator of circuits/bias.cir: how it spreads (tables 17 and 18) and how far it works (figs. 53 to 55).

#include <fmt/format.h>

#include "netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

/// circuits/bias.cir, another section of the card, other values, another temperature.
struct BiasAsked {
    std::string section = "tt";
    double I = 200e-9, supply = 0.7, celsius = 27;
    std::string more = "";
    double shift = 0;  ///< of both thresholds, V
};

std::string text_of(const BiasAsked& asked) {
    std::ifstream file(test::project_root() + "/circuits/bias.cir");
    std::string text, line;
    while (std::getline(file, line)) {
        if (line.starts_with(".expect") || line == ".end") continue;
        if (line.starts_with(".lib")) line = ".lib 'tsmc180.lib' " + asked.section;
        if (line.starts_with(".param")) line = fmt::format(".param supply={} i_bias={}", asked.supply, asked.I);
        text += line + "\n";
    }
    return text + fmt::format(".temp {}\n{}\n.end\n", asked.celsius, asked.more);
}

struct Bias {
    double V_Q, I_part, V_BN, V_BP;  ///< I_part: I_Q over the current asked for
    explicit Bias(const BiasAsked& asked) {
        Values shifted;
        if (asked.shift != 0) shifted = {{"vtn_shift", asked.shift}, {"vtp_shift", asked.shift}};
        const auto found = run_netlist(text_of(asked), shifted);
        V_Q = found.number("v(q)"), I_part = found.number("i(vis)") / asked.I;
        V_BN = found.number("v(bn)"), V_BP = found.number("v(bp)");
    }
    bool works() const { return std::abs(I_part - 1) <= 0.1; }  ///< our word for it; the thesis gives none
};

/// Means of V_Q and I_Q over 1000 chips, and their deviations in % of them; of V_Q - V_REF too.
struct Spread {
    double V = 0, I = 0, V_spread = 0, I_spread = 0, V_spread_to_ref = 0;
    Spread(const std::string& section, const std::string& what) {
        double VV = 0, II = 0, R = 0, RR = 0;
        const auto all = run_variants(text_of({.section = section, .more = ".mc 1000 seed=17 " + what}));
        const double count = static_cast<double>(all.size());
        for (const auto& one : all) {
            const double v = one.number("v(q)"), i = one.number("i(vis)"), r = one.number("v(q,ref)");
            V += v / count, VV += v * v / count, I += i / count, II += i * i / count, R += r / count, RR += r * r / count;
        }
        V_spread = 100 * std::sqrt(VV - V * V) / V, I_spread = 100 * std::sqrt(II - I * I) / I;
        V_spread_to_ref = 100 * std::sqrt(RR - R * R) / V;
    }
};

// A deviation of 1000 chips is known to 2.2 %. Printed, process / mismatch / all: V_Q 0.02, 0.19, 0.18 %, I_Q 0.77, 2.56, 2.59 %; ours V_Q
// 0.02, 0.25, 0.25 %, I_Q 0.49, 2.49, 2.55 %. Half of the power of our V_Q is the divider's, which makes V_REF of four transistors; against
// V_REF ours is 0.18 %.
TEST(Bias, SpreadsAsTables17And18Say) {
    const Spread process("mc", "mismatch=0"), mismatch("tt", "process=0"), all("mc", "");
    for (const auto* spread : {&process, &mismatch, &all}) {
        EXPECT_NEAR(spread->V, 350.1e-3, 0.1e-3);
        EXPECT_NEAR(spread->I, 199e-9, 0.7e-9);
    }
    EXPECT_NEAR(process.V_spread, 0.02, 0.005);
    EXPECT_NEAR(process.I_spread, 0.49, 0.05);
    EXPECT_NEAR(mismatch.V_spread, 0.253, 0.02);
    EXPECT_NEAR(mismatch.V_spread_to_ref, 0.185, 0.02);
    EXPECT_NEAR(mismatch.I_spread, 2.56, 0.2);
    EXPECT_NEAR(all.V_spread, 0.255, 0.02);
    EXPECT_NEAR(all.I_spread, 2.59, 0.2);
}

/// Between which currents (A), supplies (V) and temperatures (C) it works, the others as usual; where it works all over, the edge looked
/// at.
struct Ranges {
    double I[2], supply[2], celsius[2];

    Ranges(const std::string& section, double shift) {
        BiasAsked usual;
        usual.section = section, usual.shift = shift;
        if (section == "ss") usual.supply = 0.75;
        for (int side = 0; side < 2; ++side) {
            supply[side] = end_of(usual, &BiasAsked::supply, side == 0 ? 0.4 : 1.0);
            celsius[side] = end_of({.section = section, .shift = shift}, &BiasAsked::celsius, side == 0 ? -100 : 150);
            I[side] = end_of({.section = section, .shift = shift}, &BiasAsked::I, side == 0 ? 5e-9 : 5e-6);
        }
    }
    static double end_of(BiasAsked asked, double BiasAsked::* what, double edge) {
        const auto works = [&](double value) { return asked.*what = value, Bias(asked).works(); };
        double inside = asked.*what, outside = edge;
        if (works(edge)) return edge;
        for (int k = 0; k < 14; ++k) {
            const double mid = 0.5 * (inside + outside);
            (works(mid) ? inside : outside) = mid;
        }
        return inside;
    }
    void are(double I_low, double I_high, double V_low, double V_high, double T_low, double T_high) const {
        EXPECT_NEAR(I[0], I_low, 0.03 * I_low);
        EXPECT_NEAR(I[1], I_high, 0.03 * I_high);
        EXPECT_NEAR(supply[0], V_low, 3e-3);
        EXPECT_NEAR(supply[1], V_high, 3e-3);
        EXPECT_NEAR(celsius[0], T_low, 3);
        EXPECT_NEAR(celsius[1], T_high, 3);
    }
};

// Printed: 100 nA to 2 uA, 550 to 800 mV, -55 to 95 C for typical parameters. Ours, by the measure of 10 %: 30 to 610 nA, 610 to 848 mV,
// and all temperatures from -100 to 150 C.
TEST(Bias, WorksTypicallyOverThoseRanges) { Ranges("tt", 0).are(29.4e-9, 611e-9, 0.610, 0.848, -100, 150); }

// Printed, over all corners: 100 to 700 nA and 650 to 750 mV. Ours: 95 to 245 nA (ff below, ss above) and 684 to 761 mV; ff leaves off
// at 79 C ("in special for the FF corner"), ss at -34 C.
TEST(Bias, WorksOverTheCornersInASmallerOne) {
    Ranges("ss", 0).are(8.34e-9, 245e-9, 0.684, 0.935, -34, 150);
    Ranges("ff", 0).are(95e-9, 1.21e-6, 0.549, 0.761, -100, 79);
}

// What is printed of the ranges agrees with itself, but not with the unbiased 17.5 nA of table 18: every range lies where transistors are
// which carry three times as much, or whose thresholds are 35 mV lower, under body bias. With these: 77 nA to 1.04 uA, 561 to 778 mV, up to
// 95 C; the 2 uA alone is out of reach, as the bulks' junctions take the rest from 0.6 V on (their saturation current is the card's
// choice).
TEST(Bias, TransistorsOf35MillivoltsLessWouldWorkOverThePrintedRanges) { Ranges("tt", -35e-3).are(77e-9, 1.04e-6, 0.561, 0.778, -100, 95); }

TEST(Bias, HoldsItsNumbersInTheMiddleOfThePrintedRanges) {
    for (const double celsius : {-55.0, -20.0, 27.0, 60.0, 95.0}) {
        const Bias at({.celsius = celsius});
        EXPECT_NEAR(at.V_Q, 0.350, 0.4e-3) << celsius;
        EXPECT_NEAR(at.I_part, 1, 0.02) << celsius;
    }
    for (const double supply : {0.65, 0.7, 0.75, 0.8}) {
        const Bias at({.supply = supply});
        EXPECT_NEAR(at.V_Q, supply / 2, 0.5e-3) << supply;
        EXPECT_NEAR(at.I_part, 1, 0.025) << supply;
    }
    double V_BN = 0;
    for (const double I : {50e-9, 100e-9, 200e-9, 400e-9}) {
        const Bias at({.I = I});
        EXPECT_NEAR(at.V_Q, 0.350, 0.5e-3) << I;
        EXPECT_NEAR(at.I_part, 1, 0.025) << I;
        EXPECT_GT(at.V_BN, V_BN) << "fig. 53a: V_BN rises with the current";
        V_BN = at.V_BN;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
