// The card process/tsmc180.lib compared with the published properties of the thesis's transistors.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "circuit/device/uicm_card.hpp"
#include "circuit/netlist/netlist.hpp"
#include "circuit/uicm_cards.hpp"
#include "netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

using test::with_mismatch, test::with_process;

/// A model from one section of the card, as a netlist sees it.
UicmCard model(const std::string& section, const std::string& name) {
    const auto open = [](const std::string& path) -> Result<std::string> {
        std::ifstream file(path);
        if (!file) return bad_input(path + " cannot be opened");
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const auto netlist = Netlist::parse("a card\n.lib 'tsmc180.lib' " + section + "\nm1 d g s b " + name + " w=1u l=1u\n.end\n",
                                        corpuscle::test::source_root() + "/process/x.cir", open);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), UicmCard{};
    const auto circuit = netlist->elaborate();
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), UicmCard{};
    UicmCard card;
    for (const auto& m : circuit->models) {
        if (m.name != name) continue;
        EXPECT_EQ(m.values.at("level"), UicmCard::level);
        EXPECT_EQ(m.values.size(), std::size(UicmCard::fields) + 1) << name << " leaves a parameter to its default, or names one twice";
        for (const auto& field : UicmCard::fields) {
            const auto set = m.values.find(field.name);
            if (set == m.values.end()) return ADD_FAILURE() << name << " lacks " << field.name, card;
            card.*field.member = set->second;
            EXPECT_TRUE(check_range(name, {field.name, field.unit, 0, field.low, field.high, {}, {}}, set->second)) << field.name;
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

double drain_current(const UicmConstants& c, double d, double g, double s, double b) { return uicm_operating_point(c, {d, g, s, b}).I_D; }

/// The unbiased inverter with output tied to input (fig. 51a, arrays 2x8 of table 16): V_Q and I_Q.
struct TiedInverter {
    double V = 0, I = 0;  // V, A
    TiedInverter(const UicmCard& n, const UicmCard& p) {
        const auto N = array(n, 1.5e-6, 0.5e-6, 2, 8), P = array(p, 6e-6, 0.5e-6, 2, 8, true);
        double low = 0, high = 0.7;
        for (int k = 0; k < 60; ++k) {
            V = 0.5 * (low + high), I = drain_current(N, V, V, 0, 0);
            (I + drain_current(P, V, V, 0.7, 0.7) < 0 ? low : high) = V;
        }
    }
};

TEST(Tsmc180, TheUnbiasedInverterRestsAsInTable18) {
    const TiedInverter q(model("tt", "nch"), model("tt", "pch"));
    EXPECT_NEAR(q.V, 0.355, 0.5e-3);
    EXPECT_NEAR(q.I, 17.5e-9, 0.2e-9);
}

TEST(Tsmc180, CornersMoveTheInverter) {
    const TiedInverter tt(model("tt", "nch"), model("tt", "pch"));
    for (const auto* section : {"ss", "ff", "sf", "fs"}) {
        const TiedInverter q(model(section, "nch"), model(section, "pch"));
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

/// Coefficients of variation of V_Q and I_Q over 2000 chips; `draw` makes the inverter of each chip.
template <class Draw>
std::pair<double, double> spread_of(const Draw& draw) {
    double V = 0, VV = 0, I = 0, II = 0;
    constexpr int chips = 2000;
    for (int k = 0; k < chips; ++k) {
        const TiedInverter q = draw(static_cast<std::uint64_t>(k));
        V += q.V / chips, VV += q.V * q.V / chips, I += q.I / chips, II += q.I * q.I / chips;
    }
    return {std::sqrt(VV - V * V) / V, std::sqrt(II - I * I) / I};
}

TEST(Tsmc180, TheProcessSpreadIsThatOfTables17And18) {
    const UicmCard n = model("mc", "nch"), p = model("mc", "pch");
    const auto [V, I] = spread_of([&](std::uint64_t k) { return TiedInverter(with_process(n, false, 1, k), with_process(p, true, 1, k)); });
    EXPECT_NEAR(V, 0.0264, 0.002);
    EXPECT_NEAR(I, 0.284, 0.02);
}

TEST(Tsmc180, TheMismatchOfDevicesIsThatOfTables17And18) {
    const UicmCard n = model("tt", "nch"), p = model("tt", "pch");
    const auto [V, I] = spread_of([&](std::uint64_t k) {
        const auto sampled = [k](UicmCard card, double W, std::uint32_t device) {
            UicmInstance at;
            at.W = W, at.L = 0.5e-6, at.m = 2, at.stack = 8;
            const UicmInstance other = with_mismatch(at, card, 1, device, k);
            card.V_T0 += other.delvto, card.I_SQ *= other.mulu0;
            return card;
        };
        return TiedInverter(sampled(n, 1.5e-6, 0), sampled(p, 6e-6, 1));
    });
    EXPECT_NEAR(V, 0.0013, 0.0001);
    EXPECT_NEAR(I, 0.0119, 0.003);  // 1.4 %
}

TEST(Tsmc180, HighThresholdDevicesHaveThresholdsHigherBy150Millivolts) {
    EXPECT_NEAR(model("tt", "nch_hv").V_T0 - model("tt", "nch").V_T0, 0.15, 1e-12);
    EXPECT_NEAR(model("tt", "pch_hv").V_T0 - model("tt", "pch").V_T0, 0.15, 1e-12);
}

/// Drain current (A) of transistors in series at voltages d, g, b (V), solved transistor by transistor. Each is a number of elements of
/// 0.42/0.18 um in parallel; `from_source_up` has these numbers.
double stacked(const UicmCard& card, const std::vector<double>& from_source_up, double d, double g, double b) {
    std::vector<UicmConstants> parts;
    for (const double m : from_source_up) parts.push_back(array(card, 0.42e-6, 0.18e-6, m, 1));
    const auto drain_voltage = [&](double I) {  // the voltage that the last drain needs for this current; above d the current is too large
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
        (drain_voltage(mid) < d ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

TEST(Tsmc180, TheShortElementGivesTheArraysOfTables11And14) {
    const UicmCard card = model("tt", "nch018");
    const struct {
        const char* name;
        std::vector<double> parts;
        double I_D, g_mg, g_mb, g_md;  // uA, uS; g_md as corrected by errata U7 and U8
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

/// The arrays of the 0.42/0.18 um element in tables 12 and 15 (units of g_mg/A as corrected by erratum U9); parts are numbers of parallel
/// elements, from the source up.
constexpr struct {
    const char* name;
    int parts[8], count;
    double g_mg_by_I, V_A, dB, n_1, g_mg_by_area, sigma;  // 1/V, V, dB, -, uS/um^2, %
    int units() const {
        int sum = 0;
        for (int k = 0; k < count; ++k) sum += parts[k];
        return sum;
    }
    std::vector<double> stack() const { return std::vector<double>(parts, parts + count); }
} table12_and_15[] = {
    {"A", {1}, 1, 14.87, 2.10, 29.9, 0.265, 421.0, 15.6},
    {"B2", {1, 1, 1, 1}, 4, 15.07, 7.65, 41.2, 0.266, 25.43, 8.00},
    {"C2", {2, 2}, 2, 14.98, 4.11, 35.8, 0.266, 101.4, 7.73},
    {"D2", {4}, 1, 14.86, 2.10, 29.9, 0.265, 421.0, 7.41},
    {"G1", {1, 1, 1, 1, 1, 1, 1, 1}, 8, 15.18, 14.17, 46.7, 0.267, 6.425, 5.77},
    {"G2", {1, 1, 1, 1, 4}, 5, 15.17, 44.54, 56.6, 0.268, 11.55, 7.46},
    {"G3", {1, 7}, 2, 15.36, 22.15, 50.6, 0.269, 38.89, 14.9},
};

TEST(Tsmc180, TheShortElementHasTheRatiosOfTables12And15) {
    const UicmCard card = model("tt", "nch018");
    for (const auto& a : table12_and_15) {
        const double h = 1e-3, I = stacked(card, a.stack(), 0.5, 0.5, 0);
        const auto slope = [&](double d, double g, double b) {
            return (stacked(card, a.stack(), 0.5 + d, 0.5 + g, b) - stacked(card, a.stack(), 0.5 - d, 0.5 - g, -b)) / (2 * h);
        };
        const double g_mg = slope(0, h, 0), g_md = slope(h, 0, 0), area = a.units() * 0.42 * 0.18;
        EXPECT_NEAR(g_mg / I / a.g_mg_by_I, 1, 0.035) << a.name;
        EXPECT_NEAR(slope(0, 0, h) / g_mg, a.n_1, 0.003) << a.name;
        EXPECT_NEAR(1e6 * g_mg / area / a.g_mg_by_area, 1, 0.02) << a.name;
        EXPECT_NEAR(I / g_md / a.V_A, 1, 0.25) << a.name;  // a single Early voltage per length is too simple: 18 % low to 25 % high
        EXPECT_NEAR(20 * std::log10(g_mg / g_md), a.dB, 2.2) << a.name;
    }
}

TEST(Tsmc180, ArraysCarryLessThanTheirAspectRatioAsInTables11And14) {  // eq. 31 and 32, which are exact without length modulation
    const UicmCard card = model("tt", "nch018");
    const double of_one = stacked(card, {1}, 0.5, 0.5, 0);
    constexpr double published[] = {1, 0.953, 0.957, 1.000, 0.957, 0.915, 0.817};
    for (std::size_t k = 0; k < std::size(table12_and_15); ++k) {
        const auto& a = table12_and_15[k];
        double per_S = 0;
        for (const double part : a.stack()) per_S += 1 / part;
        EXPECT_NEAR(stacked(card, a.stack(), 0.5, 0.5, 0) * per_S / of_one, published[k], 0.06) << a.name;
    }
}

/// Deviation of the drain current in %, with each element sampled separately.
double mismatch_of(const std::string& devices) {
    double I = 0, II = 0;
    const auto all = run_variants("mismatch\n.lib 'tsmc180.lib' tt\nvd d 0 0.5\n" + devices + ".op\n.mc 1000 seed=5 process=0\n");
    for (const auto& one : all) I += one.number("i(vd)"), II += one.number("i(vd)") * one.number("i(vd)");
    const double count = static_cast<double>(all.size()), mean = I / count;
    return 100 * std::sqrt(II / count - mean * mean) / std::abs(mean);
}

// The deviation of 1000 samples has an error of 2.2 %, here as in the thesis. G3 (one element under seven) is 13.0 %; published is 14.9 %,
// almost that of a single element. In UICM the element at the source is not quite saturated (i_r is an eighth of i_f), so the seven others
// contribute to the deviation.
TEST(Tsmc180, ElementsSampledSeparatelyHaveTheMismatchOfTables12And15) {
    for (const auto& a : table12_and_15) {
        std::string devices;
        for (int k = 0; k < a.count; ++k)
            for (int unit = 0; unit < a.parts[k]; ++unit)
                devices += fmt::format("m{}_{} {} d {} 0 nch018 w=0.42u l=0.18u\n", k, unit,
                                       k + 1 == a.count ? "d" : fmt::format("n{}", k + 1), k == 0 ? "0" : fmt::format("n{}", k));
        const bool is_G3 = a.name == std::string("G3");
        EXPECT_NEAR(mismatch_of(devices) / a.sigma, 1, is_G3 ? 0.15 : 0.08) << a.name;
    }
}

TEST(Tsmc180, ArraysSampledAsOneDeviceVaryLikeTheirElements) {
    for (const auto& [name, m, stack, sigma] :
         {std::tuple{"A", 1, 1, 15.6}, {"B2", 1, 4, 8.00}, {"C2", 2, 2, 7.73}, {"D2", 4, 1, 7.41}, {"G1", 1, 8, 5.77}})
        EXPECT_NEAR(mismatch_of(fmt::format("m1 d d 0 0 nch018 w=0.42u l=0.18u m={} stack={}\n", m, stack)) / sigma, 1, 0.08) << name;
}

// B1, C1, D1, E and F are other geometries with other thresholds; no card exists for them. Their mismatch is compared with the card's
// sampling law at the published g_mg/I_D.
TEST(Tsmc180, OtherGeometriesFollowTheSameMismatchLaw) {
    const UicmCard card = model("tt", "nch018");
    for (const auto& [name, g_mg_by_I, area, sigma] : {std::tuple{"B1", 13.63, 0.756, 4.41},
                                                       {"C1", 16.38, 1.008, 4.39},
                                                       {"D1", 18.07, 0.4032, 7.97},
                                                       {"E", 12.96, 2.1924, 2.36},
                                                       {"F", 12.90, 2.0874, 2.51}})
        EXPECT_NEAR(100 * std::hypot(g_mg_by_I * card.A_VT, card.A_IS) / std::sqrt(area * 1e-12) / sigma, 1, 0.08) << name;
}

}  // namespace
}  // namespace corpuscle::circuit
