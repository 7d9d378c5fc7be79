// The card process/tsmc180.lib against what the thesis prints of its transistors.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "circuit/device/uicm_card.hpp"
#include "circuit/device/uicm_point.hpp"
#include "circuit/netlist/netlist.hpp"
#include "support/places.hpp"

namespace corpuscle::circuit {
namespace {

/// A model of one section of the card, as a netlist gets it.
UicmCard model(const std::string& section, const std::string& name) {
    const auto open = [](const std::string& path) -> Result<std::string> {
        std::ifstream file(path);
        if (!file) return bad_input(path + " cannot be opened");
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const auto netlist = Netlist::parse("a card\n.lib 'tsmc180.lib' " + section + "\nm1 d g s b " + name + " w=1u l=1u\n.end\n",
                                        test::root() + "/process/x.cir", open);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), UicmCard{};
    const auto circuit = netlist->elaborate();
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), UicmCard{};
    UicmCard card;
    for (const auto& m : circuit->models) {
        if (m.name != name) continue;
        EXPECT_EQ(m.values.at("level"), UicmCard::level);
        EXPECT_EQ(m.values.size(), std::size(UicmCard::fields) + 1) << name << " leaves a parameter to its default, or names one twice";
        for (const auto& field : UicmCard::fields) {
            const auto said = m.values.find(field.name);
            if (said == m.values.end()) return ADD_FAILURE() << name << " does not say " << field.name, card;
            card.*field.at = said->second;
            EXPECT_FALSE(outside(name, {field.name, field.unit, 0, field.low, field.high, {}, {}}, said->second).has_value()) << field.name;
        }
        return card;
    }
    return ADD_FAILURE() << "no model " << name, card;
}

UicmConstants array(const UicmCard& card, double W, double L, double m, double stack, bool pmos = false) {
    UicmInstance at;
    at.W = W, at.L = L, at.m = m, at.stack = stack;
    return uicm_constants(card, at, 27, pmos);
}

double drain_current(const UicmConstants& c, double d, double g, double s, double b) { return uicm_point(c, {d, g, s, b}).I_D; }

/// The unbiased inverter with output tied to input (fig. 51a, arrays 2x8 of table 16): V_Q and I_Q.
struct Quiet {
    double V = 0, I = 0;
    Quiet(const UicmCard& n, const UicmCard& p) {
        const auto N = array(n, 1.5e-6, 0.5e-6, 2, 8), P = array(p, 6e-6, 0.5e-6, 2, 8, true);
        double low = 0, high = 0.7;
        for (int k = 0; k < 60; ++k) {
            V = 0.5 * (low + high), I = drain_current(N, V, V, 0, 0);
            (I + drain_current(P, V, V, 0.7, 0.7) < 0 ? low : high) = V;
        }
    }
};

TEST(Tsmc180, TheUnbiasedInverterStandsWhereTable18Says) {
    const Quiet q(model("tt", "nch"), model("tt", "pch"));
    EXPECT_NEAR(q.V, 0.355, 0.5e-3);
    EXPECT_NEAR(q.I, 17.5e-9, 0.2e-9);
}

TEST(Tsmc180, CornersMoveTheInverter) {
    const Quiet tt(model("tt", "nch"), model("tt", "pch"));
    for (const auto* section : {"ss", "ff", "sf", "fs"}) {
        const Quiet q(model(section, "nch"), model(section, "pch"));
        const std::string name = section;
        if (name == "ss") {
            EXPECT_LT(q.I, tt.I / 2);
        }
        if (name == "ff") {
            EXPECT_GT(q.I, tt.I * 2);
        }
        if (name == "sf" || name == "fs") {
            EXPECT_GT((q.V - tt.V) * (name == "sf" ? 1 : -1), 15e-3);
        }
    }
}

/// Deviations of V_Q and I_Q, as parts of their means, over chips that `draw` makes of the inverter.
template <class Draw>
std::pair<double, double> spread_of(const Draw& draw) {
    double V = 0, VV = 0, I = 0, II = 0;
    constexpr int chips = 2000;
    for (int k = 0; k < chips; ++k) {
        const Quiet q = draw(static_cast<std::uint64_t>(k));
        V += q.V / chips, VV += q.V * q.V / chips, I += q.I / chips, II += q.I * q.I / chips;
    }
    return {std::sqrt(VV - V * V) / V, std::sqrt(II - I * I) / I};
}

TEST(Tsmc180, TheSpreadOfTheProcessIsThatOfTables17And18) {
    const UicmCard n = model("mc", "nch"), p = model("mc", "pch");
    const auto [V, I] = spread_of([&](std::uint64_t k) { return Quiet(with_process(n, false, 1, k), with_process(p, true, 1, k)); });
    EXPECT_NEAR(V, 0.0264, 0.002);
    EXPECT_NEAR(I, 0.284, 0.02);
}

TEST(Tsmc180, TheMismatchOfDevicesIsThatOfTables17And18) {
    const UicmCard n = model("tt", "nch"), p = model("tt", "pch");
    const auto [V, I] = spread_of([&](std::uint64_t k) {
        const auto drawn = [k](UicmCard card, double W, std::uint32_t device) {
            UicmInstance at;
            at.W = W, at.L = 0.5e-6, at.m = 2, at.stack = 8;
            const UicmInstance other = with_mismatch(at, card, 1, device, k);
            card.V_T0 += other.delvto, card.I_SQ *= other.mulu0;
            return card;
        };
        return Quiet(drawn(n, 1.5e-6, 0), drawn(p, 6e-6, 1));
    });
    EXPECT_NEAR(V, 0.0013, 0.0001);
    EXPECT_NEAR(I, 0.0119, 0.003);  // 1.4 %
}

TEST(Tsmc180, HigherThresholdsAreHigher) {
    EXPECT_NEAR(model("tt", "nch_hv").V_T0 - model("tt", "nch").V_T0, 0.15, 1e-12);
    EXPECT_NEAR(model("tt", "pch_hv").V_T0 - model("tt", "pch").V_T0, 0.15, 1e-12);
}

/// The current of an array at 0.5 V, its parts solved one above the other; each is `m` units of 0.42/0.18 in parallel.
double stacked(const UicmCard& card, const std::vector<double>& from_source_up, double d, double g, double b) {
    std::vector<UicmConstants> parts;
    for (const double m : from_source_up) parts.push_back(array(card, 0.42e-6, 0.18e-6, m, 1));
    const auto reached = [&](double I) {  // the voltage that the last drain needs for this current; above d: too much
        double v = 0;
        for (const auto& part : parts) {
            if (drain_current(part, d + 0.1, g, v, b) < I) return d + 0.1;
            double low = v, high = d + 0.1;
            for (int k = 0; k < 50; ++k) {
                const double mid = 0.5 * (low + high);
                (drain_current(part, mid, g, v, b) < I ? low : high) = mid;
            }
            v = 0.5 * (low + high);
        }
        return v;
    };
    double low = 0, high = drain_current(parts[0], d, g, 0, b);
    if (parts.size() == 1) return high;
    for (int k = 0; k < 50; ++k) {
        const double mid = 0.5 * (low + high);
        (reached(mid) < d ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

TEST(Tsmc180, TheShortUnitMakesTheArraysOfTables11And14) {
    const UicmCard card = model("tt", "nch018");
    const struct {
        const char* name;
        std::vector<double> parts;
        double I_D, g_mg, g_mb, g_md;  // uA, uS; g_md as errata U7 and U8 read it
    } arrays[] = {
        {"A", {1}, 2.141, 31.83, 8.430, 1.021},
        {"B2", {1, 1, 1, 1}, 0.510, 7.691, 2.051, 0.067},
        {"C2", {2, 2}, 2.048, 30.67, 8.165, 0.498},
        {"D2", {4}, 8.565, 127.3, 33.72, 4.085},
        {"G2", {1, 1, 1, 1, 4}, 0.461, 6.988, 1.870, 0.01035},
        {"G3", {1, 7}, 1.531, 23.52, 6.316, 0.06911},
    };
    for (const auto& a : arrays) {
        const double h = 1e-3, I = 1e6 * stacked(card, a.parts, 0.5, 0.5, 0);
        const auto slope = [&](double d, double g, double b) {
            return 1e6 * (stacked(card, a.parts, 0.5 + d, 0.5 + g, b) - stacked(card, a.parts, 0.5 - d, 0.5 - g, -b)) / (2 * h);
        };
        EXPECT_NEAR(I / a.I_D, 1, 0.035) << a.name;
        EXPECT_NEAR(slope(0, h, 0) / a.g_mg, 1, 0.02) << a.name;
        EXPECT_NEAR(slope(0, 0, h) / a.g_mb, 1, 0.02) << a.name;
        EXPECT_NEAR(slope(h, 0, 0) / a.g_md, 1, 0.22) << a.name;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
