// The EKV 2.6 transistor. No simulator here has it, also not Debian's ngspice. So these tests are identities and limits of the model, and
// values from its published equations. The values come from the Verilog-A text of EKV 2.6 (revision 2.6.15, which Xyce distributes),
// written once more in Python, with exact constants and an exact solution of 2 y + ln y = v. That compares two texts of the equations; it
// does not replace a comparison with another simulator.

#include <gtest/gtest.h>

#include <cmath>

#include "circuit/devices.hpp"
#include "circuit/mos_checks.hpp"
#include "support/ngspice.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit::test {
namespace {

/// A card of a 0.5 um process: 3.45 fF/um^2 ...
const Values card = {{"cox", 3.45e-3}, {"xj", 0.15e-6},  {"vto", 0.6},     {"gamma", 0.71},  {"phi", 0.97},    {"kp", 150e-6},
                     {"e0", 88e6},     {"ucrit", 4.5e6}, {"lambda", 0.23}, {"dl", -0.05e-6}, {"dw", -0.02e-6}, {"leta", 0.28},
                     {"weta", 0.05},   {"q0", 280e-6},   {"lk", 0.5e-6},   {"iba", 2e8},     {"ibb", 3.5e8},   {"ibn", 0.6},
                     {"tcv", 1.5e-3},  {"bex", -1.5},    {"ucex", 1.7},    {"ibbt", 0},      {"is", 1e-40}};
const Values short_size = {{"w", 10e-6}, {"l", 0.5e-6}}, long_size = {{"w", 1e-6}, {"l", 10e-6}};

/// A long and wide transistor without second-order effects.
const Values ideal = {{"cox", 3.45e-3}, {"gamma", 0.7}, {"phi", 0.9}, {"vto", 0.6},    {"kp", 1e-4},  {"lambda", 0},
                      {"leta", 0},      {"weta", 0},    {"e0", 1e30}, {"ucrit", 1e12}, {"is", 1e-40}, {"tnom", 27}};
const Values square = {{"w", 100e-6}, {"l", 100e-6}};
constexpr double vt = 1.380649e-23 * 300.15 / 1.602176634e-19;

Values with(Values values, const std::string& name, double value) { return values[name] = value, values; }
Values card_of(std::string_view type) { return type == "pmos" ? with(with(card, "vto", -0.6), "tcv", -1.5e-3) : card; }
Values with_everything(Values c) {
    for (const auto& [name, value] :
         Values{{"cgso", 1e-10}, {"cgdo", 2e-10}, {"cgbo", 3e-10}, {"cj", 3e-4}, {"cjsw", 2e-10}, {"hdif", 0.5e-6}, {"js", 1e-6}})
        c[name] = value;
    return c;
}

TEST(Ekv, ItsSlopesEqualFiniteDifferencesInAllRegionsAndBothPolarities) {
    for (const std::string type : {"nmos", "pmos"})
        for (const double rsh : {0.0, 50.0})
            check_slopes(MosUnderTest(ekv_kind, type, with(with_everything(card_of(type)), "rsh", rsh), short_size), 1500, 3.3);
}

TEST(Ekv, ItsSlopesAreRightWithTheMobilityOfThetaAndWhenHot) {
    auto simple = with(with(card, "theta", 0.1), "e0", 0);
    check_slopes(MosUnderTest(ekv_kind, "nmos", simple, long_size, 125), 1000, 3.3);
}

TEST(Ekv, ItsCurrentsAndChargesAddUpToZeroAndDependOnDifferencesOnly) {
    check_conservation(MosUnderTest(ekv_kind, "nmos", with_everything(card), short_size), 1000, 3.3);
}

TEST(Ekv, ExchangingDrainAndSourceExchangesCurrentsAndCharges) {
    check_exchange(MosUnderTest(ekv_kind, "nmos", with(with_everything(card), "cgdo", 1e-10), short_size), 1000, 3.3);
}

TEST(Ekv, APmosIsTheMirrorImageOfAnNmosButForTheVerticalField) {
    // eta is 1/2 for NMOS and 1/3 for PMOS; e0 = 0 removes it.
    const auto n = with(card, "e0", 0), p = with(with(n, "vto", -0.6), "tcv", -1.5e-3);
    check_mirror(MosUnderTest(ekv_kind, "nmos", n, short_size, 80), MosUnderTest(ekv_kind, "pmos", p, short_size, 80), 500, 3.3);
}

struct Reference {
    double celsius;
    bool is_short;
    double v[3];  // drain, gate, source above the bulk
    double i, impact, q_d, q_s, q_b;
};
constexpr Reference references[] = {
    {27, true, {3.3, 1, 0}, 1.2691857168e-04, 1.3396412544e-07, -1.1487494733e-15, -1.8238363575e-15, -1.0528383095e-14},
    {27, true, {0.1, 3.3, 0}, 5.2250338369e-04, 0.0000000000e+00, -1.8702615354e-14, -1.9017831744e-14, -1.1084728747e-14},
    {27, true, {3.3, 3.3, 0.5}, 2.3337977596e-03, 3.2112468970e-08, -7.7955091115e-15, -1.1811032475e-14, -1.4133951261e-14},
    {27, true, {2, 0.5, 0}, 7.9083748945e-08, 7.0132683993e-13, -2.1879502691e-18, -4.3628112203e-18, -9.4064856097e-15},
    {27, true, {0.5, 2, 1.5}, -4.0185086082e-04, 1.0323126910e-18, -3.8727781018e-15, -2.5074389470e-15, -1.3160357308e-14},
    {125, true, {3.3, 1, 0}, 1.5916820717e-04, 1.4320807900e-07, -1.6288229044e-15, -2.5794674318e-15, -1.0219891065e-14},
    {125, true, {0.1, 3.3, 0}, 3.5630495005e-04, 0.0000000000e+00, -1.9555718378e-14, -1.9870840655e-14, -1.0699316500e-14},
    {125, true, {3.3, 3.3, 0.5}, 1.9232013601e-03, 1.4150570913e-08, -8.2154320170e-15, -1.2478120915e-14, -1.3912653964e-14},
    {125, true, {2, 0.5, 0}, 3.8586863711e-06, 2.8797634445e-11, -1.0757076497e-16, -1.9979795844e-16, -9.3233427738e-15},
    {125, true, {0.5, 2, 1.5}, -3.8219372162e-04, 9.0342439815e-20, -4.5957413076e-15, -2.9661478508e-15, -1.2903009824e-14},
    {-40, true, {3.3, 1, 0}, 9.8792089612e-05, 1.1598442358e-07, -8.2017830021e-16, -1.3068136220e-15, -1.0686238283e-14},
    {-40, true, {0.1, 3.3, 0}, 7.3125605015e-04, 0.0000000000e+00, -1.8122176523e-14, -1.8437681180e-14, -1.1298824499e-14},
    {-40, true, {3.3, 3.3, 0.5}, 2.7220804274e-03, 6.0631991404e-08, -7.5082777948e-15, -1.1354514512e-14, -1.4246664316e-14},
    {-40, true, {2, 0.5, 0}, 5.0545685992e-10, 4.5751286783e-15, -1.2018245796e-20, -2.4035972424e-20, -9.3583422205e-15},
    {-40, true, {0.5, 2, 1.5}, -4.2408287175e-04, 7.7901745877e-18, -3.3741332955e-15, -2.1909618295e-15, -1.3294408638e-14},
    {27, false, {3.3, 1, 0}, 7.1510366785e-07, 7.0791587389e-10, -2.8543444270e-15, -4.5100515660e-15, -2.5060252434e-14},
    {27, false, {0.1, 3.3, 0}, 2.4736374834e-06, 0.0000000000e+00, -4.1569069909e-14, -4.2261604244e-14, -2.5630936923e-14},
    {27, false, {3.3, 3.3, 0.5}, 1.6295161114e-05, 6.1521967427e-11, -1.7138459552e-14, -2.5968176644e-14, -3.3770475071e-14},
    {27, false, {2, 0.5, 0}, 1.4915426009e-09, 1.2900877968e-14, -2.1574008467e-17, -4.2602807435e-17, -2.2558307535e-14},
    {27, false, {0.5, 2, 1.5}, -2.3303619330e-06, 7.4552173495e-22, -8.8839539462e-15, -5.7575520181e-15, -3.1042547076e-14},
    {125, false, {3.3, 1, 0}, 8.5181515600e-07, 7.1214839971e-10, -3.9315520284e-15, -6.2043015024e-15, -2.4289820960e-14},
    {125, false, {0.1, 3.3, 0}, 1.6562812644e-06, 0.0000000000e+00, -4.3477904772e-14, -4.4169920710e-14, -2.4677100240e-14},
    {125, false, {3.3, 3.3, 0.5}, 1.1912732665e-05, 2.8337102046e-11, -1.8084170823e-14, -2.7468967114e-14, -3.3183156225e-14},
    {125, false, {2, 0.5, 0}, 3.5756042849e-08, 2.4209213298e-13, -4.5307987859e-16, -8.1119289921e-16, -2.2190086698e-14},
    {125, false, {0.5, 2, 1.5}, -2.1084144968e-06, 4.6771856051e-22, -1.0502220647e-14, -6.7848480632e-15, -3.0381855575e-14},
    {-40, false, {3.3, 1, 0}, 5.9464700492e-07, 6.5920145396e-10, -2.1189235889e-15, -3.3538139142e-15, -2.5461530081e-14},
    {-40, false, {0.1, 3.3, 0}, 3.5487995460e-06, 0.0000000000e+00, -4.0275128025e-14, -4.0968475298e-14, -2.6165476726e-14},
    {-40, false, {3.3, 3.3, 0.5}, 2.1778407677e-05, 1.1358090999e-10, -1.6494751747e-14, -2.4945865147e-14, -3.4076284942e-14},
    {-40, false, {2, 0.5, 0}, 1.5057760181e-11, 1.3596401715e-16, -1.9368441164e-19, -3.8730783911e-19, -2.2479961436e-14},
    {-40, false, {0.5, 2, 1.5}, -2.6081899037e-06, 6.8367800297e-21, -7.7725953935e-15, -5.0520155319e-15, -3.1392543668e-14},
};

TEST(Ekv, CurrentsAndChargesAreThoseOfThePublishedEquations) {
    for (const auto& r : references) {
        const MosUnderTest mos(ekv_kind, "nmos", card, r.is_short ? short_size : long_size, r.celsius);
        const auto at = mos.at({r.v[0], r.v[1], r.v[2], 0});
        const double gmin_and_junctions = 1e-18;
        EXPECT_NEAR(mos.info({r.v[0], r.v[1], r.v[2], 0}, "i_d"), r.i, 1e-7 * std::abs(r.i)) << r.v[0] << ' ' << r.v[1] << ' ' << r.v[2];
        EXPECT_NEAR(-at.f[3], r.impact, 1e-7 * r.impact + gmin_and_junctions);
        const double scale = std::abs(r.q_b);
        EXPECT_NEAR(at.q[0], r.q_d, 1e-7 * std::abs(r.q_d) + 1e-13 * scale);
        EXPECT_NEAR(at.q[2], r.q_s, 1e-7 * std::abs(r.q_s) + 1e-13 * scale);
        EXPECT_NEAR(at.q[3], r.q_b, 1e-7 * std::abs(r.q_b));
    }
}

// Far below the threshold the current grows by e for each n U_T, with n = 1 + gamma / (2 sqrt(phi + V_P)), and g_m / I_D = 1 / (n U_T).
TEST(Ekv, TheWeakInversionSlopeIsThatOfTheSlopeFactor) {
    const MosUnderTest mos(ekv_kind, "nmos", ideal, square);
    for (const double v_g : {0.1, 0.2, 0.3}) {
        const double v_p = mos.info({1, v_g, 0, 0}, "v_p"), n = 1 + 0.7 / (2 * std::sqrt(0.9 + v_p));
        const double ratio = mos.info({1, v_g, 0, 0}, "g_m") / mos.info({1, v_g, 0, 0}, "i_d");
        EXPECT_NEAR(ratio * n * vt, 1, 0.03) << v_g;
        // g_ms / I_D is 1 / U_T in weak inversion, without n
        const auto at = mos.at({1, v_g, 0, 0});
        EXPECT_NEAR(-at.g(0, 2) * vt / at.f[0], 1, 0.02) << v_g;
    }
}

// g_ms U_T / I_D = 1 / (1/2 + sqrt(1/4 + i_f)) in saturation: the relation from which the interpolation of the model follows.
TEST(Ekv, TheSourceTransconductanceFollowsTheInversionCoefficient) {
    const MosUnderTest mos(ekv_kind, "nmos", ideal, square);
    for (const double v_g : {0.3, 0.5, 0.6, 0.7, 1.0, 2.0}) {
        const auto at = mos.at({3, v_g, 0, 0});
        const double i_f = mos.info({3, v_g, 0, 0}, "i_f");
        EXPECT_NEAR(-at.g(0, 2) * vt / at.f[0], 1 / (0.5 + std::sqrt(0.25 + i_f)), 2e-4) << v_g;
    }
}

/// y (1 + y) with 2 y + ln y = v, for v > 5, by iteration.
double normalized_current(double v) {
    double y = v / 2;
    for (int k = 0; k < 100; ++k) y = (v - std::log(y)) / 2;
    return y * (1 + y);
}

// In strong inversion I_D = 2 n kp W / L_eq U_T^2 (F((V_P - V_S) / U_T) - F((V_P - V_D) / U_T)), and F(v) is near (v / 2)^2. L_eq is L with
// the smooth limit to L / 10, (L + sqrt(L^2 + (L / 10)^2)) / 2.
TEST(Ekv, StrongInversionHasItsSquareLaw) {
    const MosUnderTest mos(ekv_kind, "nmos", ideal, square);
    const double L_eq = (1 + std::sqrt(1.01)) / 2;  // over L
    for (const double drain : {0.6, 1.0, 1.5, 5.0}) {
        const double v_p = mos.info({drain, 4, 0.5, 0}, "v_p"), n = mos.info({drain, 4, 0.5, 0}, "n");
        const double reverse = drain < v_p ? normalized_current((v_p - drain) / vt) : 0, forward = normalized_current((v_p - 0.5) / vt);
        EXPECT_NEAR(mos.info({drain, 4, 0.5, 0}, "i_d") / (2 * n * 1e-4 * vt * vt / L_eq * (forward - reverse)), 1, 1e-4) << drain;
        EXPECT_NEAR(forward / std::pow((v_p - 0.5) / vt / 2, 2), 1, 0.08);
    }
}

TEST(Ekv, TheChannelHasTwoThirdsOfItsCapacitanceInSaturationAndHalvesAtZero) {
    const MosUnderTest mos(ekv_kind, "nmos", ideal, square);
    const double C = 3.45e-3 * 1e-8;
    const auto even = mos.at({0, 4, 0, 0}), saturated = mos.at({5, 4, 0, 0});
    EXPECT_NEAR(-even.c(1, 2) / C, 0.5, 0.02);
    EXPECT_NEAR(-even.c(1, 0) / C, 0.5, 0.02);
    EXPECT_NEAR(-saturated.c(1, 2) / C, 2.0 / 3, 0.02);
    EXPECT_NEAR(saturated.c(1, 0) / C, 0, 0.02);
    EXPECT_NEAR(mos.at({0, -3, 0, 0}).c(1, 1) / C, 1, 0.02) << "accumulation";
}

// The thermal noise at V_DS = 0 is that of the conductance between drain and source.
TEST(Ekv, ItsThermalNoiseAtZeroVoltageIsThatOfItsConductance) {
    const MosUnderTest mos(ekv_kind, "nmos", ideal, square);
    for (const double v_g : {0.5, 1.0, 3.0}) {
        const std::array<double, 4> v{0, v_g, 0, 0};
        const double g = mos.at(v).g(0, 0) - 1e-15;
        EXPECT_NEAR(mos.device().noise(v)[0].white / (4 * 1.380649e-23 * 300.15 * g), 1, 0.05) << v_g;
    }
}

// Both have the specific current n kp U_T^2 / 2 and the slope factor n = 1 + gamma / (2 sqrt(phi)). The threshold of UICM is higher by
// n U_T (1 - ln 2), because its x is (V_P - V) / U_T + 1 where EKV has ln 2. The slope factor of EKV falls with V_P, that of UICM is
// constant.
TEST(Ekv, ALongTransistorHasTheCurrentOfUicmNearTheThreshold) {
    const double n = 1 + 0.7 / (2 * std::sqrt(0.9));
    const auto outcome = run_corpuscle(Netlist::parse(
        fmt::format("t\nvd d1 0 1.5\nvd2 d2 0 1.5\nvg g 0 0\nm1 d1 g 0 0 e w=100u l=100u\nm2 d2 g 0 0 u w=100u l=100u\n"
                    ".model e nmos(level=55 gamma=0.7 vto=0.6 phi=0.9 kp=1e-4 lambda=0 leta=0 weta=0 ucrit=1e12 e0=1e30 is=1e-40 tnom=27)\n"
                    ".model u nmos(level=80 isq={} vto={} n={} ve=1e30 zetal=0 sigmal=0 js=0 jssw=0 tcv=0)\n.dc vg 0.55 0.8 0.05\n.end\n",
                    n * 1e-4 * vt * vt / 2, 0.6 + n * vt * (1 - std::log(2)), n),
        "t.cir", {}));
    const auto plot = outcome.plots().at(0);
    const auto &ekv = plot.find_curve("i(vd)")->values, &uicm = plot.find_curve("i(vd2)")->values;
    for (std::size_t k = 0; k < ekv.size(); ++k) EXPECT_NEAR(ekv[k].real() / uicm[k].real(), 1, 0.08) << k;
}

TEST(Ekv, EachOfItsLevelsIsAcceptedAndExportNamesTheReason) {
    const TemporaryFolder folder;
    for (const int level : {44, 55, 260}) {
        folder.write("x.cir",
                     fmt::format("t\nvd d 0 1\nm1 d d 0 0 n w=10u l=1u\n.model n nmos(level={} vto=0.6 avto=1u)\n.op\n.end\n", level));
        const auto ran = run_program(folder, "run x.cir");
        EXPECT_EQ(ran.status, 0) << ran.err;
        EXPECT_NE(ran.out.find("moderate, saturation") == std::string::npos, ran.out.find("strong, saturation") == std::string::npos)
            << ran.out;
        EXPECT_NE(ran.err.find("x.cir:3:1: m1: avto of its model has no effect; only UICM (level=80) has mismatch"), std::string::npos)
            << ran.err;
        const auto exported = run_program(folder, "export x.cir --for ngspice -o y.cir");
        EXPECT_EQ(exported.status, 1);
        EXPECT_NE(exported.err.find("x.cir:3:1: m1: EKV 2.6 cannot be exported, because Debian's ngspice does not have it"),
                  std::string::npos)
            << exported.err;
    }
    folder.write("x.cir", "t\nvd d 0 1\nm1 d d 0 0 n w=10u l=1u\n.model n nmos(level=44 af=1.2)\n.op\n.end\n");
    EXPECT_NE(run_program(folder, "run x.cir").err.find("af"), std::string::npos);
}

TEST(Ekv, ARingOscillates) {
    std::string text = "ring\nvdd vdd 0 3.3\n";
    for (int k = 0; k < 5; ++k)
        text += fmt::format("mn{0} a{1} a{0} 0 0 n w=2u l=0.5u\nmp{0} a{1} a{0} vdd vdd p w=5u l=0.5u\n", k, (k + 1) % 5);
    std::string parameters;
    for (const auto& [name, value] : with_everything(card))
        if (name != "vto" && name != "tcv" && name != "kp") parameters += fmt::format(" {}={}", name, value);
    const auto outcome = run_corpuscle(
        Netlist::parse(text + ".model n nmos(level=55 vto=0.6 tcv=1.5m kp=150u" + parameters +
                           ")\n.model p pmos(level=55 vto=-0.65 tcv=-1.4m kp=45u" + parameters +
                           ")\n.ic v(a0)=0 v(a1)=3.3 v(a2)=0 v(a3)=3.3 v(a4)=0\n.tran 2p 4n\n.meas tran t1 when v(a0)=1.6 rise=2\n"
                           ".meas tran t2 when v(a0)=1.6 rise=3\n.meas tran t3 when v(a0)=1.6 rise=4\n.end\n",
                       "t.cir", {}));
    const double first = *outcome.find_number("t2") - *outcome.find_number("t1"),
                 second = *outcome.find_number("t3") - *outcome.find_number("t2");
    EXPECT_NEAR(first, second, 1e-3 * first);
    EXPECT_GT(first, 50e-12);
    EXPECT_LT(first, 1e-9);
}

}  // namespace
}  // namespace corpuscle::circuit::test
