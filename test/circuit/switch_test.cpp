// Switches (S and W): states with hysteresis in sweeps and transients, closed forms of oscillators, smooth switches, ngspice, and lines
// that are refused.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/analysis/analysis_context.hpp"
#include "circuit/batch/chip_batch.hpp"
#include "circuit/export/ngspice_deck.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/random_circuits.hpp"
#include "run/run_inputs.hpp"
#include "support/ngspice.hpp"
#include "support/property.hpp"

namespace corpuscle::circuit::test {
namespace {

/// A divider of 1 kohm and the switch; v(a) controls it.
std::string divider(const std::string& model, const std::string& rest, const std::string& state = "") {
    return fmt::format("divider\nv1 a 0 0\nvd d 0 1\nrd d o 1k\ns1 o 0 a 0 sm {}\n.model sm {}\n{}\n", state, model, rest);
}

TEST(Switch, HysteresisShowsInASweepUpAndDown) {
    const auto run = run_netlist(divider("sw(vt=1 vh=0.25 ron=1 roff=1meg)", ".dc v1 0 2 0.1 updown\n.save all i(s1)\n.print dc i(s1)"));
    const auto x = run.curve("v-sweep"), v = run.curve("v(o)"), i = run.curve("i(s1)");
    ASSERT_EQ(x.size(), 41U);
    for (std::size_t k = 0; k < x.size(); ++k) {
        const bool on = k <= 20 ? x[k] > 1.25 : x[k] > 0.75;
        EXPECT_NEAR(v[k], on ? 1.0 / 1001 : 1e6 / 1.001e6, 1e-9) << k;
        EXPECT_NEAR(i[k], on ? 1.0 / 1001 : 1 / 1.001e6, 1e-12) << "the current at each point has the state of that point; " << k;
    }
}

TEST(Switch, EachInnerSweepBeginsInTheInitialState) {
    const auto run = run_netlist(divider("sw(vt=1 vh=0.5 ron=1 roff=1meg)", ".dc v1 2 0.6 -0.2 vd 1 2 1", "on"));
    const auto v = run.curve("v(o)");
    ASSERT_EQ(v.size(), 16U);
    for (const double one : v) EXPECT_LT(one, 3e-3);
    const auto up = run_netlist(divider("sw(vt=1 vh=0.5 ron=1 roff=1meg)", ".dc v1 1 1.8 0.2 vd 1 2 1")).curve("v(o)");
    ASSERT_EQ(up.size(), 10U);
    EXPECT_GT(up[0], 0.9);
    EXPECT_LT(up[4], 0.1);
    EXPECT_GT(up[5], 1.9) << "not on, as at the end of the sweep before";
}

TEST(Switch, BetweenTheLevelsTheLineSetsTheState) {
    for (const auto& [state, high] : {std::pair{"", true}, std::pair{"off", true}, std::pair{"on", false}}) {
        const auto run =
            run_netlist(divider("sw(vt=0 vh=0.5 ron=1 roff=1meg)", ".op\n.ac lin 1 1 1\n.dc v1 1 1 1\n.tran 1u 1m\n.op", state));
        EXPECT_EQ(run.curve("v(o)", "op").back() > 0.5, high) << state;
        EXPECT_LT(run.curve("v(o)", "dc").back(), 0.5);
        EXPECT_EQ(run.curve("v(o)", "tran").front() > 0.5, high) << state << ": the sweep before has no effect";
    }
    EXPECT_LT(run_netlist(divider("sw(vt=-1 vh=0.5 ron=1 roff=1meg)", ".op", "off")).number("v(o)"), 0.5) << "beyond the level";
}

TEST(Switch, ACurrentControlsW) {
    const auto run = run_netlist(
        "w\ni1 0 a 0\nvs a 0 0\nvd d 0 1\nrd d o 1k\nw1 o 0 vs wm\n.model wm csw(it=1m ih=0.2m ron=1 roff=1meg)\n"
        ".dc i1 0 2m 0.1m updown\n");
    const auto x = run.curve("i-sweep"), v = run.curve("v(o)");
    ASSERT_EQ(x.size(), 41U);
    for (std::size_t k = 0; k < x.size(); ++k)
        if (std::abs(x[k] - 1.2e-3) > 1e-9 && std::abs(x[k] - 0.8e-3) > 1e-9) {
            EXPECT_EQ(v[k] < 0.5, k <= 20 ? x[k] > 1.2e-3 : x[k] > 0.8e-3) << k;
        }
}

/// m parallel subcircuits: the current and the controlling current are m times as large.
TEST(Switch, ParallelCopiesHaveTheVoltagesOfOne) {
    const std::string body =
        ".subckt sub c o\nvs c n 0\nrs n 0 1k\nw1 o 0 vs wm\ns1 o 0 c 0 sm\n.ends\n"
        ".model wm csw(it=1m ron=1k roff=1meg)\n.model sm sw(vt=1.5 ron=1k roff=1meg)\n";
    const auto one = run_netlist("one\nv1 c 0 1.2\nvd d 0 1\nrd d o 3k\nx1 c o sub\n.op\n" + body);
    const auto three = run_netlist("three\nv1 c 0 1.2\nvd d 0 1\nrd d o 1k\nx1 c o sub m=3\n.op\n" + body);
    EXPECT_NEAR(one.number("v(o)"), 0.25, 1e-3);
    EXPECT_NEAR(three.number("v(o)"), one.number("v(o)"), 1e-9);
}

/// The capacitor is charged through 10 kohm from 3 V to 7 V, and discharged through the switch from 7 V to 3 V.
TEST(Switch, ARelaxationOscillatorHasItsPeriod) {
    const double to = 10 * 1e9 / (1e9 + 1e4), r_up = 1 / (1e-4 + 1e-9), at = 10.0 * 100 / 10100, r_down = 1 / (1e-4 + 1e-2);
    const double period = 1e-7 * (r_up * std::log((to - 3) / (to - 7)) + r_down * std::log((7 - at) / (3 - at)));
    for (const auto& [accuracy, error] : {std::pair{"normal", 2e-5}, std::pair{"fine", 3e-6}, std::pair{"finest", 1e-7}}) {
        const auto run =
            run_netlist(fmt::format("oscillator\nv1 in 0 10\nr1 in c 10k\nc1 c 0 100n\ns1 c 0 c 0 sm\n"
                                    ".model sm sw(vt=5 vh=2 ron=100 roff=1e9)\n.options accuracy={}\n.tran 10u 20m uic\n"
                                    ".spike v(c) 5\n.meas tran high max v(c)\n.meas tran low min v(c) from=2m\n",
                                    accuracy));
        EXPECT_EQ(run.number("spikes"), 23);
        EXPECT_NEAR(run.number("mean_interval"), period, error * period) << accuracy;
        EXPECT_NEAR(run.number("high"), 7, 1e-6);
        EXPECT_NEAR(run.number("low"), 3, 1e-6);
    }
}

/// The instant does not depend on the steps: the control rises through vt at 0.3777 ms.
TEST(Switch, SwitchesWhenItsControlPassesTheLevel) {
    const auto run = run_netlist(
        "ramp\nv1 a 0 pwl(0 0 1m 1)\nvd d 0 1\nrd d o 1k\ns1 o 0 a 0 sm\n.model sm sw(vt=0.3777 ron=1 roff=1g)\n"
        "c2 p 0 1n\nr2 d p 10k\n.tran 50u 1m\n.meas tran when when v(o)=0.5\n.meas tran back min v(o)\n.print tran i(s1)\n"
        ".meas tran current max i(s1)\n");
    EXPECT_NEAR(run.number("when"), 0.3777e-3, 1e-9);
    EXPECT_NEAR(run.number("current"), 1.0 / 1001, 1e-9);
    const auto t = run.curve("time"), v = run.curve("v(o)");
    for (std::size_t k = 0; k < t.size(); ++k)
        if (std::abs(t[k] - 0.3777e-3) > 1e-9) {
            EXPECT_NEAR(v[k], t[k] < 0.3777e-3 ? 1 : 1.0 / 1001, 1e-5) << t[k];
        }
}

/// A sine is above the level for 3 % of its period, less than a step.
TEST(Switch, AShortVisitBeyondTheLevelIsNotMissed) {
    const auto run = run_netlist(
        "peaks\nv1 a 0 sin(0 1 1k)\nvd d 0 1\nrd d o 1k\ns1 o 0 a 0 sm\n.model sm sw(vt=0.995 ron=1 roff=1g)\n"
        ".tran 100u 5m\n.meas tran peaks count v(o)=0.5 fall\n");
    EXPECT_EQ(run.number("peaks"), 5);
}

/// The first switch starts the second at once, and that one the third.
TEST(Switch, ACascadeSwitchesAtOneInstant) {
    const auto run = run_netlist(
        "cascade\nv1 a 0 pwl(0 0 1m 1)\nvd d 0 1\nr1 d o1 1k\ns1 o1 0 a 0 up\nr2 d o2 1k\ns2 d o2 0 o1 down\n"
        "r3 o2 0 1k\nr4 d o3 1k\ns3 o3 0 o2 0 up2\n.model up sw(vt=0.5 ron=1 roff=1g)\n"
        ".model down sw(vt=-0.5 ron=1 roff=1g)\n.model up2 sw(vt=0.7 ron=1 roff=1g)\n.tran 10u 1m\n"
        ".meas tran first when v(o1)=0.5\n.meas tran second when v(o2)=0.7\n.meas tran third when v(o3)=0.5\n");
    for (const char* name : {"first", "second", "third"}) EXPECT_NEAR(run.number(name), 0.5e-3, 1e-9) << name;
}

std::string run_error(const std::string& text) {
    const auto circuit = make_circuit(text);
    const auto outcome = circuit ? run_directives(circuit) : Result<RunOutcome>(Error{ErrorCode::bad_input, ""});
    return outcome ? "" : outcome.error().text();
}

TEST(Switch, StatesThatAlwaysLeadToTheOtherAreReported) {
    const std::string loop = "loop\nvd d 0 1\nrd d o 1k\ns1 o 0 o 0 sm\n.model sm sw(vt=0.5 ron=1 roff=1g)\n";
    EXPECT_NE(run_error(loop + ".op\n").find("test.cir:4:1: no operating point found: s1 has no state that agrees with its control"),
              std::string::npos)
        << run_error(loop + ".op\n");
    EXPECT_NE(run_error(loop + ".tran 1u 1m uic\n").find("s1 changes its state again and again"), std::string::npos)
        << run_error(loop + ".tran 1u 1m uic\n");
}

/// The conductance of a smooth switch half way between the levels is the geometric mean; the slopes are those of its currents.
TEST(Switch, SmoothSwitchesFollowTheLogarithmOfTheirConductance) {
    for (const char* model : {"vswitch(von=1 voff=0 ron=1 roff=1meg)", "sw(vt=0.5 vh=-0.5 ron=1 roff=1meg)"}) {
        const auto context = AnalysisContext::make(make_circuit(divider(model, ".op")));
        ASSERT_TRUE(context) << context.error().text();
        const auto& device = *(*context)->system.device("s1");
        StampBuffer buffer;
        const auto current = [&](double u) {
            const double v[] = {0.3, 0.1, u, 0};
            return buffer.eval(device, v, {}).f[0];
        };
        EXPECT_NEAR(current(0.5), 0.2e-3, 1e-15);
        EXPECT_NEAR(current(-1), 0.2e-6, 1e-18);
        EXPECT_NEAR(current(2), 0.2, 1e-12);
        EXPECT_NEAR(std::log(current(0.25) / 0.2), std::log(1e-3) + std::log(1e6) * (1.5 * -0.25 + 2 * 0.25 * 0.25 * 0.25), 1e-9);
        for (const double u : {0.1, 0.4, 0.5, 0.9}) {
            const double h = 1e-6, slope = (current(u + h) - current(u - h)) / (2 * h), v[] = {0.3, 0.1, u, 0};
            const auto stamp = buffer.eval(device, v, {});
            EXPECT_NEAR(stamp.slope(0, 2), slope, 1e-6 * slope);
            EXPECT_NEAR(stamp.slope(0, 3), -slope, 1e-6 * slope);
            EXPECT_NEAR(stamp.slope(1, 2), -slope, 1e-6 * slope);
            EXPECT_NEAR(stamp.slope(0, 0) * 0.2, stamp.f[0], 1e-15);
        }
    }
}

TEST(Switch, HasTheNoiseOfItsResistance) {
    const auto with = [](const std::string& element) {
        return run_netlist("noise\nv1 in 0 dc 1 ac 1\nr1 in o 1k\nva a 0 1\n" + element + "\n.noise v(o) v1 lin 1 1k 1k\n")
            .number("onoise_spectrum");
    };
    const double resistor = with("r2 o 0 500\nrx a 0 1");
    EXPECT_NEAR(with("s1 o 0 a 0 sm\n.model sm sw(ron=500)"), resistor, 1e-9 * resistor);
    EXPECT_NEAR(with("s1 o 0 a 0 sm\n.model sm vswitch(von=0.5 ron=500)"), resistor, 1e-9 * resistor);
}

/// The force charges a capacitor, which the switch discharges.
constexpr const char* oscillating_afferent =
    "afferent\niin 0 a dc 0.1u force 1u\nca a 0 10n\ns1 a 0 a 0 sm\n.model sm sw(vt=0.55 vh=0.45 ron=10k roff=1g)\n"
    ".tran 1m 1 0 5m uic\n.spike v(a) 0.9\n";

std::vector<double> force_wave() {
    std::vector<double> out;
    for (int k = 0; k < 400; ++k) out.push_back(1 + std::sin(0.04 * k) + (k % 100 < 20 ? 1 : 0));
    return out;
}

TEST(Switch, AnAfferentContinuesBitForBitInBlocksAndAfterAPause) {
    const auto netlist = corpuscle::test::value_or_throw(parse_netlist_text(oscillating_afferent));
    const auto factory = corpuscle::test::value_or_throw(
        CircuitAfferentFactory::create(std::make_shared<const Circuit>(corpuscle::test::value_or_throw(netlist.elaborate()))));
    const auto afferent = factory->make(1e-3, false);
    auto force = force_wave();
    force.insert(force.end(), static_cast<std::size_t>(afferent->delay()), force.back());
    const auto undivided = corpuscle::test::spikes(*afferent, force, 4096);
    ASSERT_GT(undivided.size(), 20U);
    EXPECT_EQ(corpuscle::test::spikes(*afferent, force, 1), undivided);
    EXPECT_EQ(corpuscle::test::spikes(*afferent, force, 7), undivided);
    for (const std::size_t at : {3UL, 50UL, 101UL, 333UL}) {
        std::vector<Spike> spikes;
        ResponseBlock response{spikes};
        const auto first = factory->make(1e-3, false), second = factory->make(1e-3, false);
        auto state = first->start();
        ASSERT_TRUE(first->respond(std::span(force).first(at), state, response));
        auto copy = corpuscle::test::value_or_throw(unpack(pack(state)));
        ASSERT_TRUE(second->respond(std::span(force).subspan(at), copy, response));
        EXPECT_EQ(spikes, undivided) << at;
    }
}

/// Chips on SIMD lanes have no states, so chips with switches are simulated one by one.
TEST(Switch, ChipsOfABatchRespondAsOneChipDoes) {
    const auto text =
        std::string(oscillating_afferent) + ".lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\nr9 vdd q 1meg\nm1 q a 0 0 nch w=1.5u l=0.5u\n";
    const auto netlist = corpuscle::test::value_or_throw(parse_netlist_text(text));
    const auto factory = corpuscle::test::value_or_throw(
        CircuitAfferentFactory::create(std::make_shared<const Circuit>(corpuscle::test::value_or_throw(netlist.elaborate()))));
    const auto force = force_wave();
    const ChipSpec chips{3, 1};
    std::uint64_t next = 0, done = 0;
    const auto make_chip = [&](std::uint64_t k) { return Chip{static_cast<std::int64_t>(k), factory, chips.sample(k), force, 1e-3}; };
    const auto ran = run_chips(
        factory, [&]() -> std::optional<Chip> { return next < 3 ? std::optional(make_chip(next++)) : std::nullopt; },
        [&](const Chip& chip, ChipResponse&& response) {
            const auto alone = run_chip_scalar(make_chip(static_cast<std::uint64_t>(chip.id)), {});
            EXPECT_GT(response.spikes.size(), 20U);
            EXPECT_EQ(response.spikes, alone.spikes);
            ++done;
        },
        {});
    ASSERT_TRUE(ran);
    EXPECT_EQ(done, 3U);
}

std::string error_of(const std::string& body) {
    const auto netlist = Netlist::parse("title\nv1 a 0 1\nr1 a b 1\n" + body + "\n.op\n", "t.cir", {});
    if (!netlist) return netlist.error().text();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error().text();
    const auto system = System::make(std::make_shared<const Circuit>(std::move(*circuit)));
    return system ? "" : system.error().text();
}

TEST(Switch, WrongLinesAreRefusedWithTheirLocation) {
    const struct {
        const char *body, *message;
    } cases[] = {
        {"s1 b 0 a 0", "t.cir:4:11: s1: its model is missing"},
        {"s1 b 0 a 0 sx\n.model sm sw", "t.cir:4:12: s1: unknown model 'sx'; did you mean 'sm'?"},
        {"s1 b 0 a 0 sm\n.model sm csw", "t.cir:4:12: s1: model 'sm' has type csw; expected sw or vswitch"},
        {"s1 b 0 a 0 sm onn\n.model sm sw", "t.cir:4:15: s1: unexpected 'onn'; after the model, only on or off may follow"},
        {"s1 b 0 a 0 sm on off\n.model sm sw", "t.cir:4:18: s1: unexpected 'off'; after the model, only on or off may follow"},
        {"s1 b 0 a 0 sm\n.model sm sw(von=1)", "t.cir:5:1: sm: unknown parameter 'von'; did you mean 'ron'?"},
        {"s1 b 0 a 0 sm\n.model sm sw(ron=0)", "t.cir:5:1: sm: ron = 0 ohm is outside [1e-09, 1e+18]"},
        {"s1 b 0 a 0 sm\n.model sm vswitch(von=1 voff=1)",
         "t.cir:5:1: sm: the levels for on and off are both 1; a model of type sw switches abruptly"},
        {"w1 b 0 v2 wm\n.model wm csw", "t.cir:4:8: w1: unknown element 'v2'; did you mean 'v1'?"},
        {"w1 b 0 r1 wm\n.model wm csw", "t.cir:4:8: w1: 'r1' is not a voltage source; put a 0 V source in series to measure its current"},
        {"w1 b 0 v1", "t.cir:4:10: w1: its model is missing"},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of(c.body), c.message) << c.body;
}

/// Measures of the netlist here, and the output of ngspice for its export with these lines instead of its .tran and .options.
std::pair<NetlistRun, std::string> run_both(const std::string& text, const std::string& tran, const std::string& options) {
    const TemporaryFolder folder;
    auto deck = ngspice_deck(make_circuit(text));
    EXPECT_TRUE(deck) << (deck ? "" : deck.error().text());
    std::istringstream lines(deck ? deck->text : "");
    std::string changed;
    for (std::string line; std::getline(lines, line);)
        changed += (line.starts_with(".tran") ? tran : line.starts_with(".options") ? options : line) + "\n";
    folder.write("deck.cir", changed);
    return {run_netlist(text), run_ngspice(folder / "deck.cir", "")};
}

TEST(Switch, AgreesWithNgspiceInASweep) {
    const auto [here, log] = run_both(
        divider("sw(vt=1 vh=0.25 ron=7 roff=1meg)",
                "ra a 0 1k\nw1 d q v1 wm off\nrq q 0 1k\n.model wm csw(it=-1m ih=0.2m ron=3 roff=1k)\nx1 o d sw2\n.subckt sw2 o d\ns1 o z "
                "d 0 smooth\n"
                "rz z 0 100\n.ends\n.model smooth vswitch(von=2 voff=0 ron=10 roff=10k)\n.dc v1 0 2 0.1\n.meas dc edge when v(o)=0.2\n"
                ".meas dc low find v(o) at=2\n.meas dc high find v(o) at=1\n.meas dc current find v(q) at=1\n.meas dc off find v(q) at=2"),
        "", ".options reltol=1e-6");
    if (log.find("ngspice: not found") != std::string::npos) GTEST_SKIP() << "ngspice is not installed";
    for (const char* name : {"edge", "low", "high", "current", "off"})
        EXPECT_NEAR(here.number(name), logged_number(log, name), 1e-5 * std::abs(here.number(name)) + 1e-9) << name << log;
}

/// A flyback converter: coupled coils, a switch and a diode. ngspice switches up to a step late.
TEST(Switch, AFlybackConverterAgreesWithNgspice) {
    const auto [here, log] = run_both(
        "flyback\nvin in 0 24\nl1 in sw 200u\nl2 0 s 50u\nk1 l1 l2 0.98\ns1 sw 0 g 0 swm\n.model swm sw(vt=2.5 vh=0.5 ron=50m roff=1meg)\n"
        "rsn sw in 2k\nr2 s 0 500\nd1 s out dm\n.model dm d(is=1e-12 n=1.2 rs=20m)\nc1 out 0 4.7u\nr1 out 0 10\n"
        "vg g 0 pulse(0 5 0 50n 50n 4u 10u)\n.tran 50n 200u\n.meas tran vout find v(out) at=195u\n.meas tran peak max i(l1)\n"
        ".meas tran mean avg i(l2) from=100u to=200u\n",
        ".tran 5n 200u 0 5n", ".options reltol=1e-6 abstol=1e-12 vntol=1e-8");
    if (log.find("ngspice: not found") != std::string::npos) GTEST_SKIP() << "ngspice is not installed";
    for (const char* name : {"vout", "peak", "mean"})
        EXPECT_NEAR(here.number(name), logged_number(log, name), 5e-4 * std::abs(here.number(name))) << name << log;
}

/// A step-down converter with a resistance in series with its capacitor. When the switch opens, all nodes jump but the supply.
std::string buck(RandomSource& dice) {
    const double period = dice.log_uniform(4e-6, 20e-6), duty = dice.uniform_between(0.2, 0.7);
    return fmt::format(
        "buck\nv1 in 0 12\ns1 in sw g 0 sm\nvg g 0 pulse(0 5 0 20n 20n {:g} {:g})\nd1 0 sw dm\nl1 sw out {:g}\nc1 out e {:g}\nre e 0 {:g}\n"
        "r1 out 0 {:g}\n.model sm sw(ron=50m roff=1meg vt=2.5 vh={:g})\n.model dm d(is={:g} rs=5m cjo={:g})\n.tran 0.1u 200u uic\n"
        ".meas tran vo avg v(out) from=150u to=200u\n.meas tran peak max i(l1)\n",
        duty * period, period, dice.log_uniform(10e-6, 100e-6), dice.log_uniform(5e-6, 500e-6), dice.log_uniform(5e-3, 0.2),
        dice.log_uniform(1, 50), dice.uniform_between(0, 0.5), dice.log_uniform(1e-14, 1e-6), dice.log_uniform(20e-12, 500e-12));
}

TEST(Switch, ConvertersRunToTheEndAndAgreeWithATighterRun) {
    RandomSource dice(1);
    for (int k = 0; k < 12; ++k) {
        const auto text = buck(dice);
        const auto usual = run_netlist(text), tight = run_netlist(text + ".options reltol=3e-6\n");
        for (const char* name : {"vo", "peak"}) EXPECT_NEAR(usual.number(name) / tight.number(name), 1, 1e-4) << name << "\n" << text;
    }
    const auto boost = run_netlist(
        "boost\nv1 in 0 12\nl1 in sw 47u\ns1 sw 0 g 0 sm\nvg g 0 pulse(0 5 0 50n 50n 5u 10u)\nd1 sw out dm\nc1 out e 47u\nre e 0 20m\n"
        "r1 out 0 24\n.model sm sw(ron=0.1 roff=1meg vt=2.5)\n.model dm d\n.tran 0.1u 2m uic\n.meas tran vo avg v(out) from=1.9m to=2m\n");
    EXPECT_NEAR(boost.number("vo"), 23.1691, 1e-3) << "ngspice 39 with steps of 5 ns";
}

}  // namespace
}  // namespace corpuscle::circuit::test
