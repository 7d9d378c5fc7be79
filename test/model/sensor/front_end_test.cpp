// Compares the sensor and the transducers with stored reference values ("golden"), and tests front ends and afferents behind them.

#include "model/sensor/front_end.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/components.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::RunSettings;

/// Output voltage of the transducer f2v for a conductance G (S), V.
double F2v_at(double G) { return F2v::stage({}).curve(G); }

TEST(Sensor, FsrAndTransducersGiveTheGoldenCurve) {
    const auto path = test::shared_file_path("../golden/behaviour.json");
    CORPUSCLE_NEEDS(path);
    const auto golden = nlohmann::json::parse(test::read_file(path))["fsr"];
    const auto near = [&](const char* name, std::size_t k, double computed) {
        EXPECT_NEAR(computed / golden[name][k].get<double>(), 1, 1e-12) << name << ' ' << k;
    };
    const auto sensor = Fsr::stage({}), current = F2i::stage({});
    for (std::size_t k = 0; k < golden["gf"].size(); ++k) {
        const double G = sensor.curve(golden["gf"][k].get<double>() * 9.80665e-3);
        near("G_S", k, G);
        near("R_ohm", k, 1 / G);
        near("V_Z", k, F2v_at(G));
        near("I_F", k, current.curve(G));
        near("I_F0", k, F2i::stage({{"S_2", 0}}).curve(G));
    }
}

TEST(Sensor, HasItsRestingConductanceAtZeroAndNegativeForce) {
    for (const double F : {0.0, -1.0, -1e300, 1e-320}) EXPECT_EQ(Fsr::stage({}).curve(F), 1e-7) << F;
    EXPECT_TRUE(std::isfinite(Fsr::stage({{"m", 2}}).curve(1e300)));
}

TEST(Sensor, HysteresisReadsFallingForceHighByItsFractionAndRisingForceExactly) {
    const FrontEnd front({Fsr::stage({{"hysteresis", 0.1}})}, 4);
    double last = 0;
    const auto apply_hysteresis = [&](double F) { return last = front.apply_hysteresis(last, F); };
    EXPECT_EQ(apply_hysteresis(2), 2);
    EXPECT_EQ(apply_hysteresis(1.9), 2) << "it does not change while it is within 10 % above the force";
    EXPECT_DOUBLE_EQ(apply_hysteresis(1), 1.1) << "then it follows the falling force, 10 % too high";
    EXPECT_DOUBLE_EQ(apply_hysteresis(1.05), 1.1);
    EXPECT_EQ(apply_hysteresis(1.5), 1.5);
    EXPECT_EQ(apply_hysteresis(0), 0) << "0 N is exact";
    EXPECT_EQ(FrontEnd({Fsr::stage({})}, 4).apply_hysteresis(2, 1.9), 1.9) << "none by default";
}

TEST(Sensor, HysteresisDoesNotDependOnTheSamplingRate) {
    EXPECT_TRUE(rc::check("a monotone ramp, sampled ten times or only at its end", [] {
        const double h = *rc::gen::inRange(0, 100) / 100.0, last = *rc::gen::inRange(0, 1000) / 100.0,
                     from = last / (1 + *rc::gen::inRange(0, 100) / 100.0 * h), to = *rc::gen::inRange(0, 1000) / 100.0;
        const FrontEnd front({Fsr::stage({{"hysteresis", h}})}, 4);
        double sampled_often = last;
        for (int k = 1; k <= 10; ++k) sampled_often = front.apply_hysteresis(sampled_often, k == 10 ? to : from + (to - from) * k / 10);
        RC_ASSERT(std::abs(sampled_often - front.apply_hysteresis(last, to)) < 1e-12);
    }));
}

TEST(FrontEnd, CalibrationIsExactAtZeroForceAndAtTheCalibrationForce) {
    for (const auto& last : {F2v::stage({}), F2i::stage({})}) {
        const FrontEnd front({Fsr::stage({}), last}, 4);
        EXPECT_EQ(front.calibrated_force(front.read(0).value), 0);
        EXPECT_EQ(front.calibrated_force(front.read(4).value), 4);
        EXPECT_GT(front.calibrated_force(front.read(1).value), 1.2) << "between them the film's curve reads high";
        EXPECT_NEAR(front.inverse(front.read(1.7).value, 0, 5), 1.7, 1e-12);
    }
}

/// The values of each probe by name, under a force f (N). Adds the spikes and counts to `response`.
std::map<std::string, std::vector<double>> probe_values(const Afferent& a, const std::vector<double>& f, ResponseBlock& response) {
    std::vector<std::vector<double>> values(a.probes().size(), std::vector<double>(f.size()));
    std::vector<double*> rows;
    for (auto& v : values) rows.push_back(v.data());
    ResponseBlock with_probes{response.spikes, 0, rows};
    auto state = a.start();
    if (auto ok = a.respond(f, state, with_probes); !ok) throw std::runtime_error(ok.error().text());
    response.truncated_steps = with_probes.truncated_steps, response.saturated = with_probes.saturated,
    response.overflowed = with_probes.overflowed;
    std::map<std::string, std::vector<double>> out;
    for (std::size_t p = 0; p < values.size(); ++p) out[std::string(a.probes()[p].name)] = values[p];
    return out;
}

TEST(FrontEndAfferent, RespondsToTheCalibratedForceAndRecordsTheStagesBefore) {
    std::vector<Spike> behind_front_end, without_front_end;
    ResponseBlock response{behind_front_end}, direct{without_front_end};
    const auto f = test::force("press");
    const auto inside = probe_values(*test::afferent("fsr+f2v+sa1"), f, response);
    const auto direct_probes = probe_values(*test::afferent("sa1"), inside.at("F_read"), direct);
    EXPECT_EQ(behind_front_end, without_front_end);
    EXPECT_EQ(inside.at("u"), direct_probes.at("u"));
    const ParameterValues<Fsr> fsr;
    for (std::size_t k = 0; k < f.size(); k += 100) {
        EXPECT_EQ(inside.at("G_FSR")[k], Fsr::conductance(fsr, f[k]));
        EXPECT_EQ(inside.at("V_Z")[k], F2v_at(inside.at("G_FSR")[k]));
    }
    EXPECT_EQ(inside.at("F_read")[5000], 4) << "the plateau is at the calibration force";
    EXPECT_EQ(response.saturated, 0);
}

TEST(FrontEndAfferent, EverySampleBeyondTheSupplySaturatesAndIsCounted) {
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    std::vector<double> f(1000, 1.0);
    std::fill(f.begin() + 100, f.begin() + 137, 9.0);
    const auto inside = probe_values(*test::afferent("fsr+f2v+sa1"), f, response);
    EXPECT_EQ(response.saturated, 37);
    EXPECT_EQ(inside.at("V_Z")[120], 0.7);
    const auto current = probe_values(*test::afferent("fsr+f2i+sa1", {.settings = {"fsr+f2i+sa1.I_max=3uA"}}), f, response);
    EXPECT_EQ(response.saturated, 37);
    EXPECT_EQ(current.at("I_F")[120], 3e-6);
}

TEST(AfferentComponents, WrongOrUnknownComponentsAreRefusedWithASuggestion) {
    const std::pair<const char*, const char*> cases[] = {
        {"adc+fsr+sa1",
         "adc+fsr+sa1: 'fsr' is in the wrong place; the signal goes through a sensor (fsr), a transducer (f2v, f2i), a converter (adc), "
         "then the "
         "afferent"},
        {"fsr+f2v+f2i+sa1", "fsr+f2v+f2i+sa1: 'f2i' after 'f2v': use only one of them"},
        {"fsrr+sa1",
         "fsrr+sa1: 'fsrr' is not a component that fits there; did you mean 'fsr'? (the signal goes through a sensor (fsr), a transducer "
         "(f2v, "
         "f2i), a converter (adc), then the afferent)"},
        {"f2v+sa1", "f2v+sa1: f2v needs the conductance of a sensor before it, such as 'fsr+f2v+sa1'"},
        {"fsr+f2i", "fsr+f2i: 'fsr+f2i' must be followed by an afferent, such as 'fsr+f2i+sa1'"},
        {"adc+sa1-kim", "adc+sa1-kim: sa1-kim has its own front end (fsr+f2v+adc); put 'adc' before sa1a+lif-a instead"},
        {"adc+fa2",
         "adc+fa2: fast-adapting+alif has no fixed-point version; adc can be followed by sa1a, sa1b, fa1a, fa1b with lif-a, lif-b, adaptive"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(plan_afferent(text).error().message, message);
}

TEST(AfferentComponents, NamesAreMatchedWithoutRegardToCaseAlsoInSettings) {
    EXPECT_EQ(test::value_or_throw(plan_afferent("FSR+f2i+FA-I")).name, "fsr+f2i+fa1");
    for (const auto* of : {"fsr+f2i+fa1", "FSR+f2i+FA-I", "fsr+F2I+FA1"}) {
        const auto overrides = test::parse_settings({std::string(of) + ".f=3Hz", std::string(of) + ".F_cal=2N"});
        const auto plan = test::applied_or_throw(plan_afferent("FSR+f2i+FA-I", overrides));
        EXPECT_EQ(plan.value("f"), 3);
        EXPECT_EQ(plan.value("F_cal"), 2);
        EXPECT_EQ(plan.value("I_leak0"), 1e-6) << "the default of fa1";
    }
    EXPECT_EQ(test::value_or_throw(plan_afferent("sa1-kim")).composition(), "fsr+f2v+adc+sa1a+lif-a");
}

TEST(AfferentComponents, AFrontEndThatCannotMeasureItsOwnRangeIsRefused) {
    const std::pair<std::string, std::string> cases[] = {
        {"fsr+f2v+sa1.F_cal=8N", "fsr+f2v+sa1: at F_cal = 8 N V_Z would be 0.8344 V, above V_DD = 0.7 V; lower R_fb or F_cal"},
        {"sa1-kim.F_high=7N", "sa1-kim: at F_high = 7 N V_Z would be 0.7671 V, above V_DD = 0.7 V; lower R_fb or F_high"},
        {"sa1-kim.F_low=5N", "sa1-kim: F_low = 5 must be below F_high = 5"},
        {"sa1-kim.bits=3.5", "sa1-kim: bits = 3.5 must be an integer"},
        {"sa1-kim.word=18", "sa1-kim: frac = 20 must be below word = 18"},
        {"sa1-kim.word=22",
         "sa1-kim: the force of a code = 5 (units: N, uA, V, steps) does not fit a word of 22 bits with 20 fraction bits; raise "
         "word, or "
         "lower frac"},
    };
    for (const auto& [setting, message] : cases) {
        const auto overrides = test::parse_settings({setting});
        EXPECT_EQ(plan_afferent(overrides[0].target, overrides).error().message, message);
    }
    const auto undetectable = test::parse_settings({"fsr+sa1.F_cal=1uN", "fsr+sa1.m=2", "fsr+sa1.R_1gf=1e12", "fsr+sa1.R_0=1"});
    EXPECT_EQ(plan_afferent("fsr+sa1", undetectable).error().message,
              "fsr+sa1: F_cal = 1e-06 N gives the same reading as 0 N with this sensor; raise F_cal");
}

}  // namespace
}  // namespace corpuscle
