// The bipolar transistor: its slopes and charges, closed forms, its lines and cards, and a bandgap reference.

#include <gtest/gtest.h>

#include <cmath>

#include "circuit/bipolar/bipolar_cards.hpp"
#include "circuit/device/gummel_poon/equations.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

/// The model "complete" of cards.lib with a base resistance that depends on the current, as an NPN or a PNP.
std::string complete_model(const std::string& type = "npn") { return type + changed_card("complete", "rbm=20", "rbm=5 irb=4u").substr(3); }

/// One transistor of a netlist, which can be evaluated at any voltages.
class OneTransistor {
    std::unique_ptr<AnalysisContext> context_;
    StampBuffer buffer_;

public:
    /// `model`: "npn(is=1e-16)"; `options`: of the transistor's line.
    explicit OneTransistor(const std::string& model, const std::string& options = "", double celsius = 27) {
        const auto circuit =
            make_circuit("one transistor\n.temp " + std::to_string(celsius) + "\nvc c 0 0\nvb b 0 0\nve e 0 0\nvs s 0 0\nq1 c b e s m " +
                         options + "\n.model m " + model + "\n.end\n");
        auto made = AnalysisContext::make(circuit);
        EXPECT_TRUE(made) << (made ? "" : made.error().text());
        if (made) context_ = std::move(*made);
    }
    const Device& device() const { return *context_->system.device("q1"); }
    std::size_t unknowns() const { return device().unknowns.size(); }
    Stamp eval(const std::vector<double>& v, double gmin = 1e-12) { return buffer_.eval(device(), v, {0, 1, gmin, true}); }
    /// The voltages of all unknowns from those of collector, base, emitter and substrate. Inner nodes differ a little from the outer ones.
    std::vector<double> voltages(double c, double b, double e, double s) const {
        std::vector<double> out = {c, b, e, s};
        const double outer[] = {c - 0.003, b - 0.011, e + 0.004};
        for (std::size_t k = 0; out.size() < unknowns(); ++k) out.push_back(outer[k]);  // all three have a resistance, or none
        return out;
    }
    /// A value of the table of the operating point.
    double info(const std::vector<double>& v, std::string_view name) const {
        for (const auto& value : device().operating_info(v))
            if (value.name == name) return value.value;
        return ADD_FAILURE() << "no value " << name, std::nan("");
    }
};

/// Voltages of collector, base, emitter, substrate for an NPN: off, active at low and high currents, saturation, reverse, far reverse.
constexpr double bias_points[][4] = {{3, 0.1, 0, -1},      {3, 0.45, 0, -0.4},     {5, 0.72, 0, -2},     {1, 0.95, 0.05, 0.2},
                                     {0.08, 0.7, 0, -0.3}, {0.02, 0.81, 0, 0.1},   {0, 0.62, 1.7, -0.2}, {-0.1, 0.75, 2, 0.3},
                                     {4, -3, 0, -1},       {-0.5, -1.5, -0.7, 0.1}};

/// Parameters of different kinds of transistors.
std::vector<std::string> parameter_lists() {
    std::vector<std::string> out = {"(is=1e-16)", "(is=1e-16 vaf=20 var=3 ikf=1m tf=1n cje=1p)", complete_model().substr(3)};
    const std::pair<const char*, const char*> changes[] = {
        {"rb=30", "rb=30"}, {"itf=0.3", "itf=0 subs=-1"}, {"vtf=2.2", "vtf=0 subs=1"}, {"nkf=0.55 ", ""}, {"rbm=20 ", ""}};
    for (const auto& [before, after] : changes) out.push_back(changed_card("complete", before, after).substr(3));
    return out;
}

/// Expects the slopes to be central differences of the values, for one row and column.
void expect_slope(double slope, double up, double down, double h, double largest, const std::string& what) {
    EXPECT_NEAR(slope, (up - down) / (2 * h), 2e-6 * std::abs(slope) + 1e-9 * largest) << what;
}

TEST(Bipolar, ItsSlopesAreTheDerivativesOfItsCurrentsAndCharges) {
    const double h = 1e-5;  // V
    int compared = 0;
    for (const std::string type : {"npn", "pnp"})
        for (const auto& card : parameter_lists())
            for (const double celsius : {-40.0, 27.0, 125.0}) {
                OneTransistor one(type + card, "area=2 m=1.5", celsius);
                for (const auto& point : bias_points) {
                    const double sign = type == "npn" ? 1 : -1;
                    const auto v = one.voltages(sign * point[0], sign * point[1], sign * point[2], sign * point[3]);
                    const auto n = v.size();
                    const auto copy = [](std::span<double> values) { return std::vector<double>(values.begin(), values.end()); };
                    const auto here = one.eval(v);
                    const auto df = copy(here.df), dq = copy(here.dq);
                    for (std::size_t column = 0; column < n; ++column) {
                        auto up = v, down = v;
                        up[column] += h, down[column] -= h;
                        const auto above = one.eval(up);
                        const auto f = copy(above.f), q = copy(above.q);
                        const auto below = one.eval(down);
                        for (std::size_t row = 0; row < n; ++row, ++compared) {
                            const auto what = fmt::format("{} {} C, {} {} {}: row {}, column {}", type + card, celsius, point[0], point[1],
                                                          point[2], row, column);
                            double largest_f = 0, largest_q = 0;
                            for (std::size_t k = 0; k < n; ++k)
                                largest_f = std::max(largest_f, std::abs(df[row * n + k])),
                                largest_q = std::max(largest_q, std::abs(dq[row * n + k]));
                            expect_slope(df[row * n + column], f[row], below.f[row], h, largest_f, "current of " + what);
                            expect_slope(dq[row * n + column], q[row], below.q[row], h, largest_q, "charge of " + what);
                        }
                    }
                }
            }
    EXPECT_GT(compared, 5000);
}

TEST(Bipolar, ItsCurrentsAndItsChargesAddUpToZero) {
    for (const std::string type : {"npn", "pnp"})
        for (const auto& card : parameter_lists()) {
            OneTransistor one(type + card);
            for (const auto& point : bias_points) {
                const auto out = one.eval(one.voltages(point[0], point[1], point[2], point[3]));
                double f = 0, q = 0, largest_f = 0, largest_q = 0;
                for (std::size_t k = 0; k < one.unknowns(); ++k) {
                    f += out.f[k], q += out.q[k];
                    largest_f = std::max(largest_f, std::abs(out.f[k])), largest_q = std::max(largest_q, std::abs(out.q[k]));
                }
                EXPECT_LE(std::abs(f), 1e-14 * largest_f) << type << card;
                EXPECT_LE(std::abs(q), 1e-14 * largest_q) << type << card;
            }
        }
}

TEST(Bipolar, APnpIsTheMirrorImageOfAnNpn) {
    OneTransistor npn(complete_model()), pnp(complete_model("pnp") + " subs=1");
    for (const auto& point : bias_points) {
        const auto n = npn.eval(npn.voltages(point[0], point[1], point[2], point[3]));
        auto v = npn.voltages(point[0], point[1], point[2], point[3]);
        for (double& x : v) x = -x;
        const auto p = pnp.eval(v);
        for (std::size_t k = 0; k < v.size(); ++k) {
            EXPECT_EQ(n.f[k], -p.f[k]) << k;
            EXPECT_EQ(n.q[k], -p.q[k]) << k;
        }
        for (std::size_t k = 0; k < v.size() * v.size(); ++k) {
            EXPECT_EQ(n.df[k], p.df[k]) << k;
            EXPECT_EQ(n.dq[k], p.dq[k]) << k;
        }
    }
}

const double v_t = thermal_voltage(300.15);  // V, at 27 C

TEST(Bipolar, TheIdealOneIsExponential) {
    OneTransistor one("npn(is=1e-15 bf=80 br=4)");
    for (const double v : {0.2, 0.5, 0.75}) {
        const auto forward = one.eval({v, v, 0, 0}, 0);  // base and collector connected
        EXPECT_NEAR(forward.f[0], 1e-15 * (std::exp(v / v_t) - 1), 1e-12 * forward.f[0]);
        EXPECT_NEAR(forward.f[1], forward.f[0] / 80, 1e-12 * forward.f[1]);
        const auto reverse = one.eval({0, v, v, 0}, 0);
        EXPECT_NEAR(reverse.f[2], 1e-15 * (std::exp(v / v_t) - 1), 1e-12 * reverse.f[2]);
        EXPECT_NEAR(reverse.f[1], reverse.f[2] / 4, 1e-12 * reverse.f[1]);
    }
}

TEST(Bipolar, EarlyVoltagesSetTheSlopeOfTheCollectorCurrent) {
    OneTransistor one("npn(is=1e-15 bf=80 vaf=50)");
    const double at_zero = one.eval({0.65, 0.65, 0, 0}, 0).f[0];
    for (const double v_cb : {1.0, 5.0, 25.0})
        EXPECT_NEAR(one.eval({0.65 + v_cb, 0.65, 0, 0}, 0).f[0], at_zero * (1 + v_cb / 50), 1e-9 * at_zero) << v_cb;
    const std::vector<double> v = {3.65, 0.65, 0, 0};
    EXPECT_NEAR(one.info(v, "go"), one.info(v, "ic") / 53, 1e-6 * one.info(v, "go"));
    EXPECT_NEAR(one.info(v, "gm"), one.info(v, "ic") / v_t, 1e-3 * one.info(v, "gm"));
}

TEST(Bipolar, TheGainFallsAtTheKneeCurrent) {
    OneTransistor one("npn(is=1e-15 bf=100 ikf=1m)");
    const double knee = v_t * std::log(1e-3 / 1e-15 + 1);  // V: here i_f = ikf, and q_b = (1 + sqrt 5) / 2
    const auto at_knee = one.eval({knee, knee, 0, 0}, 0);
    EXPECT_NEAR(at_knee.f[0] / at_knee.f[1], 200 / (1 + std::sqrt(5)), 1e-9);
    const double far = knee + 0.3;  // far above it: i_c = sqrt(is ikf) exp(v / 2 V_t)
    EXPECT_NEAR(one.eval({far, far, 0, 0}, 0).f[0] / (std::sqrt(1e-18) * std::exp(far / 2 / v_t)), 1, 2e-3);
}

TEST(Bipolar, TheBaseResistanceFallsToItsSmallestValue) {
    EXPECT_EQ(crowding(0).value, 1);
    EXPECT_EQ(crowding(-1).value, 1);
    EXPECT_NEAR(crowding(1).value, 0.5, 0.03);  // irb: the current at which it has fallen halfway, nearly
    EXPECT_LT(crowding(1e4).value, 0.02);
    for (double x = 1e-7; x < 1e7; x *= 1.5) {
        const double h = 1e-4 * x;
        EXPECT_NEAR(crowding(x).slope, (crowding(x + h).value - crowding(x - h).value) / (2 * h), 1e-6 * std::abs(crowding(x).slope) + 1e-8)
            << x;
    }
    OneTransistor one("npn(is=1e-15 bf=100 ikf=1m rb=100 rbm=20 rc=1 re=1)");
    std::vector<double> v = {3, 0.9, 0, 0, 3, 0.9 - 1e-3, 0};  // 1 mV across rb
    EXPECT_NEAR(1e-3 / one.eval(v, 0).f[1], 20, 5);
    v[1] = 0.3, v[5] = 0.3 - 1e-3;
    EXPECT_NEAR(1e-3 / one.eval(v, 0).f[1], 100, 1e-3);
}

TEST(Bipolar, AreaAndMMultiplyCurrentsAndChargesAndDivideResistances) {
    const std::string model = complete_model();
    OneTransistor one(model), six(model, "2 m=3");
    for (const auto& point : bias_points) {
        const auto v = one.voltages(point[0], point[1], point[2], point[3]);
        const auto a = one.eval(v, 0), b = six.eval(v, 0);
        for (std::size_t k = 0; k < v.size(); ++k) {
            EXPECT_NEAR(b.f[k], 6 * a.f[k], 1e-12 * std::abs(b.f[k]) + 1e-25) << k;
            EXPECT_NEAR(b.q[k], 6 * a.q[k], 1e-12 * std::abs(b.q[k]) + 1e-30) << k;
        }
    }
}

TEST(Bipolar, TheGainHasItsTemperatureExponent) {
    OneTransistor hot("npn(is=1e-15 bf=80 xtb=1.5)", "temp=127");
    const auto out = hot.eval({0.5, 0.5, 0, 0}, 0);
    EXPECT_NEAR(out.f[0] / out.f[1], 80 * std::pow(400.15 / 300.15, 1.5), 1e-9);
    const double is = 1e-15 * std::exp(3 * std::log(400.15 / 300.15) + 1.11 / thermal_voltage(400.15) * (400.15 / 300.15 - 1));
    EXPECT_NEAR(out.f[0], is * (std::exp(0.5 / thermal_voltage(400.15)) - 1), 1e-9 * out.f[0]);
}

TEST(Bipolar, ItsNoiseIsShotAndThermalNoise) {
    const auto run = run_netlist(
        "shot noise of the collector\nvc c 0 2\nvb b 0 0.65 ac 1\nq1 c b 0 m\n.model m npn(is=1e-15 bf=100)\nh1 o 0 vc 1\n"
        ".noise v(o) vb lin 1 1k 1k\n.op\n.end\n");
    const double density = std::sqrt(-2 * electron_charge * run.curve("i(vc)", "op")[0]);
    EXPECT_NEAR(run.curve("onoise_spectrum")[0], density, 1e-6 * density);

    OneTransistor one("npn(is=1e-15 bf=100 rb=100 re=2 rc=5 kf=1e-10 af=1.5)", "area=2 m=4");
    const std::vector<double> v = {2, 0.65, 0, 0, 2, 0.65, 0};
    const double i_c = one.info(v, "ic"), i_b = one.info(v, "ib"), four_kt = 4 * boltzmann * 300.15;
    for (const auto& source : one.device().noise(v)) {
        const std::string name(source.mechanism);
        const double white = name == "shot ic"      ? 2 * electron_charge * i_c
                             : name == "shot ib"    ? 2 * electron_charge * i_b
                             : name == "thermal rb" ? four_kt * 8 / 100
                             : name == "thermal re" ? four_kt * 8 / 2
                             : name == "thermal rc" ? four_kt * 8 / 5
                                                    : 0;
        EXPECT_NEAR(source.white, white, 1e-9 * white) << name;
        const double flicker = name == "flicker" ? 4 * 1e-10 * std::pow(i_b / 4, 1.5) : 0;
        EXPECT_NEAR(source.flicker, flicker, 1e-9 * flicker) << name;
    }
    EXPECT_EQ(one.device().noise(v).size(), 6U);
}

TEST(Bipolar, ItsSmallSignalsAreTheSlopesOfItsOperatingPoints) {  // also with a base resistance that depends on the current
    const std::string circuit = "slope\nvc cc 0 3\nrc cc c 100\nvb bb 0 {vb} ac 1\nrb bb b 100\nq1 c b 0 m\n.param vb=0.8\n.model m " +
                                complete_model() + "\n.op\n.ac lin 1 1m 1m\n.end\n";
    const double h = 1e-5;
    const auto up = run_netlist(circuit, {{"vb", 0.8 + h}}), down = run_netlist(circuit, {{"vb", 0.8 - h}}), here = run_netlist(circuit);
    for (const std::string node : {"v(c)", "v(b)"}) {
        const double slope = (up.curve(node, "op")[0] - down.curve(node, "op")[0]) / (2 * h);
        EXPECT_NEAR(here.curve(node, "ac")[0], slope, 1e-5 * std::abs(slope)) << node;
    }
}

TEST(Bipolar, ItsRegionFollowsFromItsJunctions) {
    OneTransistor npn("npn(is=1e-15)"), pnp("pnp(is=1e-15)");
    const std::vector<std::pair<std::vector<double>, std::string>> points = {
        {{3, 0, 0, 0}, "off"}, {{3, 0.6, 0, 0}, "active"}, {{0.1, 0.7, 0, 0}, "saturation"}, {{0, 0.6, 2, 0}, "reverse"}};
    for (const auto& [v, region] : points) {
        EXPECT_EQ(npn.device().operating_region(v), region);
        EXPECT_EQ(pnp.device().operating_region(std::vector<double>{-v[0], -v[1], -v[2], 0}), region);
    }
}

TEST(Bipolar, ItsCollectorCurrentCanBeSaved) {
    const auto run = run_netlist(
        "collector\nv1 c 0 2\nib 0 b 1u\nq1 c b 0 m\n.model m npn(bf=150)\n.options gmin=1e-15\n.dc ib 1u 3u 1u\n.save i(q1) "
        "i(v1)\n.end\n");
    for (const std::size_t k : {0U, 1U, 2U}) {
        EXPECT_NEAR(run.curve("i(q1)")[k], 150e-6 * static_cast<double>(k + 1), 1e-9);
        EXPECT_NEAR(run.curve("i(v1)")[k], -run.curve("i(q1)")[k], 1e-12);
    }
}

TEST(Bipolar, ASubstrateJunctionWithoutCurrentHasNoneFarForwardEither) {  // 0 exp(v) is not a number there
    OneTransistor one("npn(is=1e-15 cjs=1p)");
    const std::vector<double> v = {-40, -40, -40, 0};
    const auto out = one.eval(v, 1e-12);
    EXPECT_NEAR(out.f[3], 40e-12, 1e-20);
    for (const double slope : out.df) EXPECT_TRUE(std::isfinite(slope));
}

TEST(Bipolar, NewtonsMethodFindsTheOperatingPointOfAnAmplifierFromZero) {
    for (const std::string celsius : {"-40", "27", "125"}) {
        const auto run =
            run_netlist("a 741\nvcc vcc 0 15\nvee vee 0 -15\nvin inp 0 0.5\n.include ../test/circuit/bipolar/ua741.inc\n.temp " + celsius +
                        "\n.op\n.end\n");
        ASSERT_TRUE(run.is_complete());
        EXPECT_TRUE(run.analyses()[0].result.table.starts_with("found by newton (1")) << run.analyses()[0].result.table.substr(0, 60);
        EXPECT_NEAR(run.number("v(out)"), 0.5, 2e-3);
    }
}

// ---- lines and cards ----

/// The error of a netlist with this line and this model, or its first warning.
std::string message_of(const std::string& line, const std::string& model = "npn(is=1e-15)") {
    const auto netlist = parse_netlist_text("t\n" + line + "\nv1 c 0 1\nr1 c b 1k\n.model m " + model + "\n.tran 1n 2n\n.end\n");
    if (!netlist) return netlist.error().text();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error().text();
    const auto shared = std::make_shared<const Circuit>(std::move(*circuit));
    const auto made = AnalysisContext::make(shared);
    if (!made) return made.error().text();
    auto warnings = shared->warnings;
    for (auto& warning : netlist_warnings(*shared)) warnings.push_back(std::move(warning));
    return warnings.empty() ? "" : warnings[0].text();
}

TEST(Bipolar, ItsLineHasThreeOrFourNodesAndOptions) {
    for (const std::string line : {"q1 c b 0 m", "q1 c b 0 0 m", "q1 c b 0 m 2", "q1 c b 0 0 m {1+1}", "q1 c b 0 m area=2 m=3 temp=50",
                                   "Q1 C B 0 M dtemp=5", "q1 (c b 0) m"})
        EXPECT_EQ(message_of(line), "") << line;
    const std::string more = "perhaps substrate, then the model";
    const std::vector<std::pair<std::string, std::string>> refused = {
        {"q1 c b", ":2:7: q1: 2 nodes, but expected 3: collector, base, emitter, " + more},
        {"q1 c b 0", ":2:9: q1: its model is missing"},
        {"q1 c b 0 mm", ":2:10: q1: unknown model 'mm'; did you mean 'm'?"},
        {"q1 c b 0 0 mm", ":2:12: q1: unknown model 'mm'; did you mean 'm'?"},
        {"q1 c b 0 0 0 m", ":2:12: q1: a fifth node (the temperature) is not supported; remove it"},
        {"q1 c b 0 m 2 3", ":2:14: q1: unexpected '3'"},
        {"q1 c b 0 m 2 area=3", ":2:12: q1: unexpected '2'"},
        {"q1 c b 0 m area=0", ":2:1: q1: area = 0 must be positive"},
        {"q1 c b 0 m areab=2", ":2:12: q1: unknown parameter 'areab'; did you mean 'area'?"},
        {"q1 c b 0 m off", ":2:1: q1: off has no effect"},
        {"q1 c b 0 m ic=0.6,5", ":2:1: q1: ic= of a diode or transistor has no effect"},
    };
    for (const auto& [line, message] : refused) EXPECT_NE(message_of(line).find(message), std::string::npos) << message_of(line);
}

TEST(Bipolar, WhatACardHasBeyondTheModelIsRefusedOrNamed) {
    const std::vector<std::pair<std::string, std::string>> refused = {
        {"npn(level=4)", ":5:1: m: bipolar transistor level 4 is not supported; use level=1"},
        {"npn(bff=80)", ":5:1: m: unknown parameter 'bff'; did you mean 'bf'?"},
        {"npn(bf=-3)", ":5:1: m: bf = -3 is outside"},
        {"npn(rco=1)", ":5:1: m: models of type npn have no parameter 'rco', so it has no effect"},
        {"npn(trc1=1m)", ":5:1: m: models of type npn have no parameter 'trc1', so it has no effect"},
        {"npn(rb=1 rbm=3)", ":5:1: m: rbm = 3 ohm must not exceed rb = 1 ohm"},
        {"npn(subs=2)", ":5:1: m: subs = 2 must be 1 (vertical) or -1 (lateral)"},
        {"nmos(vto=1)", ":2:10: q1: model 'm' has type nmos; expected npn or pnp"},
        {"npn(tf=1n ptf=30)", ":5:1: m: ptf has no effect"},
    };
    for (const auto& [model, message] : refused)
        EXPECT_NE(message_of("q1 c b 0 m", model).find(message), std::string::npos) << message_of("q1 c b 0 m", model);
    EXPECT_EQ(message_of("q1 c b 0 m", "npn(level=1 rco=0 vo=3 trc1=0 vceo=40 icrating=1)"), "");
}

TEST(Bipolar, AWarningAboutAModelAppearsOnce) {
    const auto circuit = make_circuit("t\nq1 c b 0 m\nq2 c b 0 m\nv1 c 0 1\nr1 c b 1k\n.model m npn(tf=1n ptf=30)\n.op\n.end\n");
    EXPECT_EQ(circuit->warnings.size(), 1U);
}

TEST(Bipolar, VeryLargeValuesOfACardMeanNone) {
    const std::string circuit = "large\nvb b 0 0.7\nvc c 0 5\nq1 c b 0 m\n.op\n.model m npn(is=1e-15 ";
    const auto plain = run_netlist(circuit + "mje=0.99)\n"),
               large = run_netlist(circuit + "ikr=1e99 ikf=1e99 vaf=1e50 var=1e99 mje=0.99)\n");
    EXPECT_NEAR(large.number("i(vc)") / plain.number("i(vc)"), 1, 1e-9);
}

TEST(Bipolar, TheExponentOfHighCurrentsHasTheNameOfPspiceToo) {
    const std::string circuit = "exponent\nvb b 0 0.9\nvc c 0 5\nq1 c b 0 m\n.op\n.model m npn(is=1e-15 ikf=1m ";
    EXPECT_EQ(run_netlist(circuit + "nk=0.8)\n").number("i(vc)"), run_netlist(circuit + "nkf=0.8)\n").number("i(vc)"));
}

TEST(Bipolar, ACardHasOtherNames) {
    const auto read = [](const Values& values) {
        Model model;
        model.name = "m", model.type = "npn", model.values = values;
        const auto card = read_bipolar_card(model);
        EXPECT_TRUE(card) << (card ? "" : card.error().text());
        return card ? *card : BipolarCard{};
    };
    const auto card =
        read({{"is", 2e-15}, {"va", 30}, {"ik", 0.1}, {"vb", 4}, {"pe", 0.6}, {"me", 0.4}, {"c2", 100}, {"ccs", 1e-12}, {"rb", 7}});
    EXPECT_EQ((std::vector{card.vaf, card.ikf, card.var, card.vje, card.mje, card.cjs}), (std::vector{30.0, 0.1, 4.0, 0.6, 0.4, 1e-12}));
    EXPECT_EQ((std::vector{card.ise, card.rbm, card.ibe}), (std::vector{100 * 2e-15, 7.0, 2e-15}));
    EXPECT_EQ(read({{"ibe", 3e-15}, {"ibc", 4e-15}}).ibc, 4e-15);
    EXPECT_EQ(read({{"ibe", 3e-15}}).ibe, 1e-16);  // as in ngspice, it needs both
}

// ---- a circuit ----

TEST(Bipolar, ABandgapReferenceAddsThermalVoltageAndJunction) {
    const auto netlist = Netlist::read(corpuscle::test::source_root() + "/examples/circuits/bandgap.cir");
    ASSERT_TRUE(netlist) << netlist.error().text();
    auto circuit = netlist->elaborate();
    ASSERT_TRUE(circuit) << circuit.error().text();
    const auto run = run_netlist(std::move(*circuit));
    const double per_kelvin = boltzmann / electron_charge * std::log(8.0);  // V/K
    EXPECT_NEAR(run.number("ptat"), per_kelvin, 0.01 * per_kelvin);
    const auto ptat = run.curve("v(b,e2)"), reference = run.curve("v(ref)");
    EXPECT_NEAR((ptat.back() - ptat.front()) / 165, per_kelvin, 0.01 * per_kelvin);  // from -40 to 125 C
    const auto [low, high] = std::minmax_element(reference.begin(), reference.end());
    EXPECT_LT(*high - *low, 0.01 * *low);
    EXPECT_NEAR(*low, 1.25, 0.02);
    EXPECT_EQ(run.expectations().size(), 4U);
    for (const auto& e : run.expectations()) EXPECT_TRUE(e.is_met) << e.name;
}

}  // namespace
}  // namespace corpuscle::circuit
