// Netlists as afferents: spikes of complete and divided forces, saved and resumed states, error messages.

#include "circuit/afferent/circuit_afferent.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "circuit/netlist_runner.hpp"
#include "run/afferent_plan.hpp"
#include "run/run_inputs.hpp"
#include "support/program.hpp"
#include "support/property.hpp"

namespace corpuscle::circuit {
namespace {

using corpuscle::test::read_file;
using corpuscle::test::TemporaryFolder;
using corpuscle::test::value_or_throw;

/// Force charges a capacitor, and a fast switch discharges it at 1 V. Fast to simulate; it has no stable operating point.
constexpr const char* relaxer =
    "relaxer\niin 0 a dc 0.1u force 1u\nca a 0 10n\nb1 a 0 i={1m*v(a)*0.5*(1+tanh((v(s)-0.5)*20))}\n"
    "b2 t 0 v={0.5*(1+tanh((v(a)-1+0.8*v(s))*20))}\nr2 t s 1k\nc2 s 0 10n\n.tran 1m 1 0 5m uic\n";

std::shared_ptr<const CircuitAfferentFactory> design(const std::string& text) {
    const auto netlist = value_or_throw(parse_netlist_text(text));
    return value_or_throw(CircuitAfferentFactory::create(std::make_shared<const Circuit>(value_or_throw(netlist.elaborate()))));
}
std::string afferent_error(const std::string& text) {
    const auto netlist = parse_netlist_text(text);
    if (!netlist) return netlist.error().text();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error().text();
    const auto factory = CircuitAfferentFactory::create(std::make_shared<const Circuit>(std::move(*circuit)));
    return factory ? "" : factory.error().text();
}
std::string spiker() { return read_file(corpuscle::test::source_root() + "/circuits/spiker.cir"); }

std::string noisy_spiker() {
    auto text = spiker();
    return text.insert(text.find('\n') + 1, ".options noisefmax=2k\n");
}

/// Spikes for a force given in blocks of `block` samples, with delay() samples appended to get the complete response.
std::vector<Spike> complete_response(const Afferent& afferent, std::vector<double> force, std::size_t block = 4096) {
    force.insert(force.end(), static_cast<std::size_t>(afferent.delay()), force.back());
    return corpuscle::test::spikes(afferent, force, block);
}

/// Force in N: a sine, and a step of 1 N in the first 20 ms of every 100 ms. `T` is the sample period, s.
std::vector<double> wave(std::size_t count, double T) {
    std::vector<double> out;
    for (std::size_t k = 0; k < count; ++k) {
        const double t = static_cast<double>(k) * T;
        out.push_back(1 + std::sin(40 * t) + (std::fmod(t, 0.1) < 0.02 ? 1 : 0));
    }
    return out;
}

TEST(CircuitAfferent, FiresFasterUnderMoreForce) {
    const auto afferent = design(spiker())->make(1e-3, false);
    std::size_t before = 0;
    for (const double force : {0.5, 1.0, 2.0, 4.0, 8.0}) {
        const auto spikes = complete_response(*afferent, std::vector<double>(300, force));
        EXPECT_GT(spikes.size(), before) << force;
        before = spikes.size();
    }
    EXPECT_EQ(complete_response(*afferent, std::vector<double>(300, 0.0)).size(), 0U);
}

TEST(CircuitAfferent, SpikesAreInOrderWithinTheForceAndOnSamplesIfRequested) {
    const auto factory = design(spiker());
    const auto exact = complete_response(*factory->make(1e-3, false), wave(400, 1e-3)),
               sampled = complete_response(*factory->make(1e-3, true), wave(400, 1e-3));
    ASSERT_GT(exact.size(), 10U);
    ASSERT_EQ(sampled.size(), exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k) {
        EXPECT_TRUE(exact[k].offset > 0 && exact[k].offset <= 1);
        EXPECT_TRUE(k == 0 || exact[k - 1] < exact[k]);
        EXPECT_TRUE(exact[k].step > 0 && exact[k].step < 400);
        EXPECT_EQ(sampled[k].step, exact[k].step);
        EXPECT_EQ(sampled[k].offset, 1);
    }
}

TEST(CircuitAfferent, ForceInBlocksOfAnySizeGivesTheSameSpikes) {
    for (const auto& text : {spiker(), noisy_spiker(), std::string(relaxer) + ".spike v(s) 0.5\n.save v(a) v(a,s)\n"}) {
        const auto afferent = design(text)->make(1e-3, false);
        const auto force = wave(300, 1e-3);
        const auto undivided = complete_response(*afferent, force);
        ASSERT_GT(undivided.size(), 10U);
        EXPECT_EQ(complete_response(*afferent, force, 1), undivided);
        EXPECT_EQ(complete_response(*afferent, force, 7), undivided);
        EXPECT_EQ(complete_response(*afferent, force, 100), undivided);
    }
}

TEST(CircuitAfferent, ProbesAreTheSameInBlocksOfAnySize) {
    const auto afferent = design(spiker())->make(1e-3, false);
    ASSERT_EQ(afferent->probes().size(), 2U);
    EXPECT_EQ(afferent->probes()[0].name, "v(u)");
    EXPECT_EQ(afferent->probes()[0].unit, "V");
    const auto force = wave(300, 1e-3);
    const auto probe_values = [&](std::size_t block) {
        std::vector<double> u(force.size()), s(force.size());
        std::vector<Spike> spikes;
        auto state = afferent->start();
        for (std::size_t k = 0; k < force.size(); k += block) {
            double* to[] = {u.data() + k, s.data() + k};
            ResponseBlock response{spikes, 0, to};
            if (!afferent->respond(std::span(force).subspan(k, std::min(block, force.size() - k)), state, response)) ADD_FAILURE();
        }
        u.insert(u.end(), s.begin(), s.end());
        return u;
    };
    const auto undivided = probe_values(300), parts = probe_values(13);
    EXPECT_EQ(undivided, parts);
    for (const double v : undivided) EXPECT_TRUE(v > -0.01 && v < 0.71) << v;
    EXPECT_NEAR(undivided[0], 0.6, 1e-3);  // .ic
}

/// Spikes of an afferent that runs up to sample `at` and saves its state as bytes, followed by those of a second afferent that continues.
std::vector<Spike> resumed(const CircuitAfferentFactory& factory, const std::vector<double>& force, std::size_t at, double T) {
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    std::vector<std::byte> saved;
    {
        const auto first = factory.make(T, false);
        auto state = first->start();
        if (!first->respond(std::span(force).first(at), state, response)) ADD_FAILURE();
        saved = pack(state);
    }
    const auto second = factory.make(T, false);
    auto other = second->start();  // it has responded to another force before
    std::vector<Spike> other_spikes;
    ResponseBlock other_response{other_spikes};
    if (!second->respond(wave(90, T), other, other_response)) ADD_FAILURE();
    auto state = value_or_throw(unpack(saved));
    auto rest = std::vector<double>(force.begin() + static_cast<std::ptrdiff_t>(at), force.end());
    rest.insert(rest.end(), static_cast<std::size_t>(second->delay()), force.back());
    if (!second->respond(rest, state, response)) ADD_FAILURE();
    return spikes;
}

TEST(CircuitAfferent, AResumedAfferentContinuesBitForBit) {
    const auto factory = design(spiker());
    const auto force = wave(250, 1e-3);
    const auto undivided = complete_response(*factory->make(1e-3, false), force);
    EXPECT_TRUE(rc::check([&] {
        const auto at = *rc::gen::inRange<std::size_t>(1, force.size());
        RC_ASSERT(resumed(*factory, force, at, 1e-3) == undivided);
    }));
}

TEST(CircuitAfferent, KeepsItsPrecisionForHours) {
    const auto factory = design("slow\niin 0 a force 1\nr1 a 0 1\nc1 a 0 0.1\n.spike v(a) 0.5\n.tran 1 1 0 0.2\n");
    std::vector<double> force;
    for (int k = 0; k < 40000; ++k) force.push_back(k % 200 < 100 ? 1 : 0);  // 4000 s: a touch of 10 s every 20 s
    const auto spikes = complete_response(*factory->make(0.1, false), force);
    ASSERT_EQ(spikes.size(), 199U);  // the force of the first touch starts before t = 0
    for (std::size_t k = 1; k < spikes.size(); ++k) {
        EXPECT_EQ(spikes[k].step - spikes[k - 1].step, 200) << k;
        EXPECT_NEAR(spikes[k].offset, spikes[0].offset, 1e-3) << k;
    }
    EXPECT_EQ(complete_response(*factory->make(0.1, false), force, 333), spikes);
    EXPECT_EQ(resumed(*factory, force, 12345, 0.1), spikes);
}

TEST(CircuitAfferent, ADamagedStateIsRejectedOrHarmless) {
    const auto afferent = design(spiker())->make(1e-3, false);
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    auto good = afferent->start();
    const auto force = wave(100, 1e-3);
    ASSERT_TRUE(afferent->respond(force, good, response));
    auto other = good;
    other.format += "x";
    EXPECT_FALSE(afferent->respond(force, other, response));
    auto cut = good;
    cut.values.resize(cut.values.size() / 2);
    const auto refused = afferent->respond(force, cut, response);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("a saved state is damaged"), std::string::npos) << refused.error().message;
    EXPECT_TRUE(rc::check([&] {
        auto bad = good;
        bad.values[*rc::gen::inRange<std::size_t>(0, bad.values.size())] = *rc::gen::element(-1.0, 0.0, 0.5, 3.0, 1e9, 1e300, -1e300);
        std::vector<Spike> some;
        ResponseBlock any{some};
        (void)afferent->respond(std::span(force).first(20), bad, any);
    }));
    EXPECT_EQ(complete_response(*afferent, force), complete_response(*design(spiker())->make(1e-3, false), force));
}

TEST(CircuitAfferent, CopiesHaveNoiseOfTheirOwn) {
    const auto factory = design(noisy_spiker());
    const auto force = wave(300, 1e-3);
    const auto response = [&](std::uint32_t copy) { return complete_response(*factory->make(1e-3, false, copy), force); };
    EXPECT_EQ(response(1), response(1));
    EXPECT_NE(response(1), response(2));
    EXPECT_NE(response(0), response(1));
    EXPECT_EQ(response(1).size(), response(2).size());
}

TEST(CircuitAfferent, ALevelThatIsNeverReachedGivesNoSpike) {
    EXPECT_EQ(complete_response(*design(std::string(relaxer) + ".spike v(s) 5\n")->make(1e-3, false), wave(300, 1e-3)).size(), 0U);
}

TEST(CircuitAfferent, FallSelectsTheFallingEdge) {
    const auto rise = complete_response(*design(std::string(relaxer) + ".spike v(s) 0.5 rise\n")->make(1e-3, false), wave(300, 1e-3)),
               fall = complete_response(*design(std::string(relaxer) + ".spike v(s) 0.5 fall\n")->make(1e-3, false), wave(300, 1e-3));
    ASSERT_GT(rise.size(), 10U);
    ASSERT_NEAR(static_cast<double>(rise.size()), static_cast<double>(fall.size()), 1);
    for (std::size_t k = 0; k < fall.size(); ++k) EXPECT_LT(rise[k], fall[k]);
}

TEST(CircuitAfferent, ErrorsNameTheirLocation) {
    const std::string t = "t\niin 0 a force 1u\nr1 a 0 1k\n", file = corpuscle::test::source_root() + "/process/test.cir";
    const auto expect_error = [&](const std::string& text, const std::string& what) {
        EXPECT_NE(afferent_error(text).find(what), std::string::npos) << afferent_error(text);
    };
    expect_error("t\niin 0 a 1u\nr1 a 0 1k\n.spike v(a) 1\n", file + ": no source carries a force; add one, such as 'iin 0 fin force 60n'");
    expect_error(t, file + ": no .spike directive defines the spike output; add '.spike v(NODE) LEVEL [rise|fall]'");
    expect_error(t + ".spike v(b) 1\n", file + ":4:8: .spike: unknown output v(b); did you mean 'v(a)'?");
    expect_error(t + ".spike v(a) 1\n.spike v(a) 2\n", file + ":5:1: .spike: only one is allowed; the first is in line 4");
    expect_error(t + ".spike v(a)\n", file + ":4:1: .spike: v(a) needs a level to cross");
    expect_error(t + ".spike\n", file + ":4:1: .spike: an output is missing");
    expect_error(t + ".spike v(a) high\n", file + ":4:13: .spike: 'high' is not a number; expected the level to cross");
    expect_error(t + ".spike v(a) 1 up\n", file + ":4:15: .spike: 'up' must be rise or fall");
    expect_error(t + ".spike v(a) 1 rise now\n", file + ":4:20: .spike: unexpected 'now'");
    expect_error("t\niin 0 a force 1u 2u\nr1 a 0 1k\n.spike v(a) 1\n", file + ":2:9: iin: force has 2 numbers; expected force [scale]");
    EXPECT_EQ(afferent_error(t + ".spike v(a) 1\n"), "");
}

TEST(CircuitAfferent, AStateIsRefusedIfOnlyAControllingSourceTheKindOfABSourceOrTheMethodDiffers) {
    const auto state_format = [](const std::string& lines) {
        return design("t\niin 0 a force 1u\nr1 a 0 1k\nv1 b 0 1\nr2 b 0 1k\nv2 c 0 1\nr3 c 0 1k\nr4 d 0 1k\n" + lines + ".spike v(a) 1\n")
            ->make(1e-3, false)
            ->start()
            .format;
    };
    for (const auto& [one, other] : {std::pair{"f1 0 d v1 1\n", "f1 0 d v2 1\n"}, std::pair{"b1 d 0 v=v(b)\n", "b1 d 0 i=v(b)\n"},
                                     std::pair{".options method=gear\n", ".options method=trap\n"}}) {
        EXPECT_NE(state_format(one), state_format(other)) << one << other;
        EXPECT_EQ(state_format(one), state_format(one));
    }
}

TEST(CircuitAfferent, CopiesAreTheChipsOfTheNetlistsMonteCarloRun) {
    auto text = spiker();
    text.insert(text.find(".save"), ".options accuracy=fine\n.mc 3 seed=5\n.meas tran u max v(u)\n");
    text.replace(text.find("' tt") + 2, 2, "mc");
    const auto cut = text.find(".expect");
    text.replace(cut, text.find(".end", cut) - cut, "");
    const auto chips = run_variants(text);
    ASSERT_EQ(chips.size(), 3U);
    const auto factory = design(text);
    const auto press = corpuscle::test::force("press");
    const auto clock = value_or_throw(make_clock(10e3));
    for (std::uint32_t copy = 1; copy <= 3; ++copy) {
        const auto spikes = spike_times(complete_response(*factory->make(1e-4, false, copy), press), clock);
        EXPECT_EQ(static_cast<double>(spikes.size()), chips[copy - 1].number("spikes")) << copy;
        EXPECT_NEAR(spikes[0], chips[copy - 1].number("first_spike"), 1e-6) << copy;
        EXPECT_NE(spikes[0], spike_times(complete_response(*factory->make(1e-4, false), press), clock)[0]);
    }
}

TEST(CircuitAfferent, AStateOfThePreviousVersionIsRejectedWithBothVersionsAndARemedy) {
    const auto afferent = design(spiker())->make(1e-3, false);
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    auto before = afferent->start();
    const auto at = before.format.find("/2, ");
    ASSERT_NE(at, std::string::npos) << before.format;
    before.format[at + 1] = '1';
    before = value_or_throw(unpack(pack(before)));
    const auto refused = afferent->respond(wave(20, 1e-3), before, response);
    ASSERT_FALSE(refused);
    const auto& message = refused.error().message;
    EXPECT_NE(message.find("the saved state has version 1, but this program reads version 2; start again with start()"), std::string::npos)
        << message;
    before = afferent->start();  // the remedy
    EXPECT_TRUE(afferent->respond(wave(20, 1e-3), before, response));
}

TEST(CircuitAfferent, AStateOfAnotherNetlistIsRejected) {
    const auto a = design(std::string(relaxer) + ".spike v(s) 0.5\n"), b = design(std::string(relaxer) + ".spike v(s) 0.6\n");
    EXPECT_NE(a->make(1e-3, false)->start().format, b->make(1e-3, false)->start().format);
    EXPECT_NE(a->make(1e-3, false)->start().format, a->make(2e-3, false)->start().format);
}

TEST(Run, ReportsSpikesUnderTheForceOfTheNetlist) {
    const std::string t = "t\niin 0 a dc 0.1 force 1\nr1 a 0 1\nc1 a 0 1m\n.spike v(a) 1.1\n";
    const auto run = run_netlist(t + ".force press f_min=0 f_max=2 rate=2k\n.tran 1m 1\n");
    EXPECT_EQ(run.number("spikes"), 1);
    EXPECT_NEAR(run.number("first_spike"), 0.3135, 1e-3);  // the middle of the ramp plus 1 ms
    EXPECT_NEAR(run.curve("v(a)").front(), 0.1, 1e-6);
    EXPECT_EQ(run_netlist(t + ".tran 1m 1\n").number("spikes"), 0);  // no force: 0 N
    EXPECT_NEAR(run_netlist(t + ".op\n.force press\n").number("v(a)"), 0.1, 1e-9);
    const auto refused = [&](const std::string& directive) {
        auto circuit = value_or_throw(value_or_throw(parse_netlist_text(t + directive + "\n.tran 1m 1\n")).elaborate());
        const auto run_ = run_directives(std::make_shared<const Circuit>(std::move(circuit)));
        return run_ ? std::string() : run_.error().text();
    };
    EXPECT_NE(refused(".force prees").find(":6:8: .force: "), std::string::npos) << refused(".force prees");
    EXPECT_NE(refused(".force press f_mox=1").find("did you mean 'F_max'?"), std::string::npos) << refused(".force press f_mox=1");
    EXPECT_NE(refused(".force press f_max").find(":6:14: .force: 'f_max' must be PARAMETER=VALUE"), std::string::npos);
    EXPECT_NE(refused(".force press\n.force step").find("only one is allowed"), std::string::npos);
    EXPECT_NE(refused(".force").find("a stimulus is missing"), std::string::npos) << refused(".force");
}

/// Stores everything it receives.
struct RecordingListener final : Sink {
    std::vector<Spike> spikes;
    std::vector<double> probe_values;
    std::int64_t samples = 0;
    bool wants_probes() const override { return true; }
    Result<void> block(const Input&, const RunBlock& a) override {
        EXPECT_EQ(a.first_sample, samples);
        samples += static_cast<std::int64_t>(a.steps);
        for (const auto& s : a.spikes) {
            EXPECT_TRUE(s.step >= a.first_sample && s.step < samples);
            spikes.push_back(s);
        }
        for (std::size_t k = 0; k < a.steps; ++k)
            for (const auto& unit : a.probes)
                for (const auto& probe : unit) probe_values.push_back(probe[k]);
        return {};
    }
};

TEST(Respond, NetlistsAndModelsRespondTheSameInBlocksOfAnySize) {
    const auto path = corpuscle::test::source_root() + "/circuits/spiker.cir";
    std::vector<RecordingListener> recorders(3);
    for (std::size_t k = 0; k < recorders.size(); ++k) {
        const std::vector<AfferentPlan> plans = {value_or_throw(plan_any_afferent(path)).result,
                                                 value_or_throw(plan_any_afferent("fa1")).result};
        std::vector<std::unique_ptr<ForceSource>> sources;
        sources.push_back(value_or_throw(make_stimulus("press", 1e3, 0)));
        Sink* listeners[] = {&recorders[k]};
        RespondOptions options;
        options.block = std::vector<std::size_t>{4096, 1, 37}[k];
        const auto work = value_or_throw(corpuscle::run(sources, plans, listeners, options));
        EXPECT_EQ(work.samples, 1000);
        EXPECT_GT(work.steps, 10000);
        EXPECT_EQ(recorders[k].samples, 1000);
        EXPECT_TRUE(recorders[k].spikes == recorders[0].spikes);
        EXPECT_TRUE(recorders[k].probe_values == recorders[0].probe_values);
    }
    EXPECT_GT(recorders[0].spikes.size(), 60U);
}

class Responding : public ::testing::Test {
protected:
    const TemporaryFolder folder;
    std::string arguments(const std::string& afferents, const std::string& options = "") const {
        return "respond press.csv --afferent " + afferents + " --time t " + options;
    }
    void SetUp() override {
        std::string text = "t_s,a_N,b_N,c_N\n";
        for (int k = 0; k < 500; ++k) {
            const double t = k / 1000.0;
            text += fmt::format("{},{},{},{}\n", t, std::abs(4 * std::sin(6 * t)), k < 250 ? 0.0 : 2.0, 1.0);
        }
        folder.write("press.csv", text);
        folder.write("relaxer.cir", std::string(relaxer) + ".spike v(s) 0.5\n");
        std::filesystem::copy(corpuscle::test::source_root() + "/circuits/spiker.cir", folder / "spiker.cir");
        auto cir = spiker();
        cir.replace(cir.find("../process"), 10, corpuscle::test::source_root() + "/process");
        folder.write("spiker.cir", cir);
    }
};

TEST_F(Responding, NetlistsAndModelsRespondTheSameOnAnyNumberOfThreads) {
    const std::string names = "sa1,./spiker.cir,relaxer.cir";
    const auto one = corpuscle::test::run_program(folder, arguments(names, "--out one --probe-files -j 1 --report"));
    ASSERT_EQ(one.status, 0) << one.err;
    ASSERT_EQ(corpuscle::test::run_program(folder, arguments(names, "--out four --probe-files -j 4")).status, 0);
    for (const std::string name : {"/spikes.csv", "/probes.csv"})
        EXPECT_TRUE(read_file(folder / ("one" + name)) == read_file(folder / ("four" + name))) << name;
    const auto summary = nlohmann::json::parse(read_file(folder / "one/summary.json"));
    EXPECT_EQ(summary["afferents"][1]["name"], "./spiker.cir");
    EXPECT_EQ(summary["afferents"][1]["composition"], "netlist");
    EXPECT_GT(summary["work"]["circuits"]["steps"], 1000);
    EXPECT_EQ(summary["work"]["circuits"]["not_converged"], 0);
    const auto spikes = read_file(folder / "one/spikes.csv");
    for (const std::string train : {"\nsa1,a,", "\n./spiker.cir,a,", "\n./spiker.cir,b,", "\nrelaxer.cir,c,"})
        EXPECT_NE(spikes.find(train), std::string::npos) << train;
    const auto probes = read_file(folder / "one/probes.csv");
    EXPECT_NE(probes.substr(0, probes.find('\n')).find("./spiker.cir.b.v(u) [V]"), std::string::npos);
    EXPECT_EQ(std::count(probes.begin(), probes.end(), '\n'), 501);
    EXPECT_EQ(probes.find("nan"), std::string::npos);
}

TEST_F(Responding, NetlistsCannotRunInFloat) {
    ASSERT_EQ(corpuscle::test::run_program(folder, arguments("spiker.cir", "--out whole")).status, 0);
    ASSERT_EQ(corpuscle::test::run_program(folder, arguments("spiker.cir", "--out float --float")).status, 2);
    const auto refused = corpuscle::test::run_program(folder, arguments("spiker.cir", "--float"));
    EXPECT_NE(refused.err.find("spiker.cir: netlists cannot run in float"), std::string::npos) << refused.err;
}

TEST_F(Responding, ANetlistThatDoesNotConvergeIsReportedAndTheOthersContinue) {
    // C dv/dt = F - 0.5 - 2 v^2 - v^6: below 0.5 N, v falls without limit
    folder.write("falls.cir",
                 "falls\niin 0 a force 1\nb1 a 0 i={0.5+v(a)*v(a)*v(a)*v(a)*v(a)*v(a)-0*v(a)+2*v(a)*v(a)}\nca a 0 1m\n.spike v(a) 0.2\n");
    const auto ran = corpuscle::test::run_program(folder, arguments("sa1,falls.cir,spiker.cir", "--out answer"));
    EXPECT_EQ(ran.status, 3) << ran.err;
    EXPECT_NE(ran.err.find("did not converge"), std::string::npos) << ran.err;
    const auto summary = nlohmann::json::parse(read_file(folder / "answer/summary.json"));
    EXPECT_GT(summary["work"]["circuits"]["not_converged"], 0);
    EXPECT_NE(read_file(folder / "answer/spikes.csv").find("\nspiker.cir,a,"), std::string::npos);
    EXPECT_NE(read_file(folder / "answer/spikes.csv").find("\nsa1,a,"), std::string::npos);
}

TEST_F(Responding, ANetlistThatCannotBeReadIsRejected) {
    const auto none = corpuscle::test::run_program(folder, arguments("none.cir"));
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.err.find("none.cir: cannot be read"), std::string::npos) << none.err;
    folder.write("bad.cir", "t\niin 0 a force\nr1 a\n.spike v(a) 1\n");
    const auto bad = corpuscle::test::run_program(folder, arguments("bad.cir"));
    EXPECT_EQ(bad.status, 1);
    EXPECT_NE(bad.err.find("bad.cir:3:"), std::string::npos) << bad.err;
    EXPECT_EQ(corpuscle::test::run_program(folder, arguments("spiker.cir,spiker.cir")).status, 2);
    const auto unknown = corpuscle::test::run_program(folder, arguments("spiker.cir", "--set spiker.cir.vddd=1"));
    EXPECT_EQ(unknown.status, 1);
    EXPECT_NE(unknown.err.find("--set spiker.cir.vddd=1: spiker.cir has no parameter or device 'vddd'"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace corpuscle::circuit
