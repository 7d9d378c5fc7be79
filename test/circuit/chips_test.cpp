// The thesis's chips, transistor by transistor: their responses to force, compared with the thesis's description and its models.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/netlist_runner.hpp"
#include "corpuscle/respond.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

/// Response of one chip to one force.
struct ChipRun {
    std::vector<double> spikes;                                 // s
    std::map<std::string, std::vector<double>> probes_by_name;  // one value per sample for each output of .save
    std::vector<RangeViolation> outside;
    std::optional<Error> error;

    std::size_t between(double from, double to) const {
        return static_cast<std::size_t>(std::count_if(spikes.begin(), spikes.end(), [&](double t) { return t >= from && t < to; }));
    }
};

ChipRun run_chip(const std::string& file, const Force& stimulus_force, const Values& parameters = {}, double celsius = 27) {
    ChipRun out;
    const auto netlist = Netlist::read(corpuscle::test::source_root() + "/circuits/" + file);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), out;
    auto circuit = netlist->elaborate(parameters);
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), out;
    circuit->temperature = celsius;
    const auto design = CircuitAfferentFactory::create(std::make_shared<const Circuit>(std::move(*circuit)));
    if (!design) return ADD_FAILURE() << design.error().text(), out;
    const auto afferent = (*design)->make(1 / stimulus_force.rate, false);
    const auto delay = static_cast<std::size_t>(afferent->delay());
    auto force = stimulus_force.samples[0];
    force.insert(force.end(), delay, force.back());
    std::vector<std::vector<double>> curves(afferent->probes().size(), std::vector<double>(force.size()));
    std::vector<double*> probes;
    for (auto& c : curves) probes.push_back(c.data());
    std::vector<Spike> spikes;
    out.outside.resize(afferent->ranges().size());
    auto state = afferent->start();
    ResponseBlock response{spikes, 0, probes, out.outside};
    if (auto ok = afferent->respond(force, state, response); !ok) out.error = ok.error();
    for (const auto& s : spikes) out.spikes.push_back((static_cast<double>(s.step) - 1 + s.offset) / stimulus_force.rate);
    for (std::size_t p = 0; p < curves.size(); ++p) {
        curves[p].erase(curves[p].begin(), curves[p].begin() + static_cast<std::ptrdiff_t>(delay));
        out.probes_by_name[std::string(afferent->probes()[p].name)] = std::move(curves[p]);
    }
    return out;
}

std::vector<double> spikes_of(const NetlistRun& ran) {
    for (const auto& a : ran.analyses())
        if (a.result.spikes) return *a.result.spikes;
    return ADD_FAILURE() << ran.title() << ": no spikes", std::vector<double>();
}

constexpr double rise_start = 0.25, hold_start = 0.375, fall_start = 0.625, fall_end = 0.75;  // s, of the press
constexpr std::array phase_ends = {rise_start, hold_start, fall_start, fall_end, 1.0};

/// Number of spikes in each phase of the press.
std::array<int, 5> phase_counts(const std::vector<double>& spikes) {
    std::array<int, 5> out{};
    for (const double t : spikes)
        ++out[static_cast<std::size_t>(std::upper_bound(phase_ends.begin(), phase_ends.end() - 1, t) - phase_ends.begin())];
    return out;
}

/// Highest instantaneous frequency, Hz.
double peak_frequency(const std::vector<double>& spikes) {
    double shortest = 1e9;
    for (std::size_t k = 1; k < spikes.size(); ++k) shortest = std::min(shortest, spikes[k] - spikes[k - 1]);
    return 1 / shortest;
}

TEST(SaChip, FiresUnderThePressLikeItsModel) {
    const auto press = stimulus("press");
    const auto model = respond("sa1", press);
    for (const char* file : {"sa1.cir", "sa1_biased.cir"}) {
        const auto chip = run_chip(file, press);
        EXPECT_EQ(chip.between(0, rise_start), 0U) << "silent at rest";
        ASSERT_GT(chip.between(rise_start, hold_start), 2U);
        const auto first = std::find_if(chip.spikes.begin(), chip.spikes.end(), [](double t) { return t >= hold_start; });
        for (auto t = first + 1; t + 1 < chip.spikes.end() && t[1] < fall_start; ++t)
            EXPECT_GT(t[1] - t[0], t[0] - t[-1]) << "intervals grow on the plateau, at " << *t;
        EXPECT_GT(chip.between(fall_start - 0.05, fall_start), 0U) << "fires until the end of the plateau";
        const auto counts = phase_counts(chip.spikes), expected = phase_counts(model.times);
        for (std::size_t k = 0; k < counts.size(); ++k) EXPECT_NEAR(counts[k], expected[k], 1) << file << ", phase " << k;
        EXPECT_NEAR(peak_frequency(chip.spikes), peak_frequency(model.times), 0.05 * peak_frequency(model.times)) << file;
    }
}

TEST(FaChip, FiresInBothRampsAndNotAtTheEndOfThePlateau) {
    const auto press = stimulus("press");
    const auto model = respond("fa1", press);
    for (const char* file : {"fa1.cir", "fa1_biased.cir"}) {
        const auto chip = run_chip(file, press);
        EXPECT_EQ(chip.between(0, rise_start), 0U);
        EXPECT_GT(chip.between(rise_start, hold_start), 0U);
        EXPECT_EQ(chip.between(fall_start - 0.1, fall_start), 0U);
        EXPECT_GT(chip.between(fall_start, fall_end), 0U);
        EXPECT_EQ(phase_counts(chip.spikes), phase_counts(model.times)) << file;
        EXPECT_NEAR(peak_frequency(chip.spikes), peak_frequency(model.times), 0.15 * peak_frequency(model.times)) << file;
    }
}

/// hv_membrane=0 is the reading in which switches and leak mirror have the standard threshold. Its spikes are those of the netlists that
/// were written for it.
TEST(Chips, WithTheStandardThresholdKeepTheirSpikes) {
    const auto press = stimulus("press");
    const auto sa1 = run_chip("sa1.cir", press, {{"hv_membrane", 0}}), fa1 = run_chip("fa1.cir", press, {{"hv_membrane", 0}});
    EXPECT_EQ(phase_counts(sa1.spikes), (std::array{0, 5, 8, 1, 0}));
    EXPECT_NEAR(sa1.spikes.front(), 0.314896, 1e-6);
    EXPECT_NEAR(sa1.spikes.back(), 0.668934, 1e-6);
    EXPECT_EQ(phase_counts(fa1.spikes), (std::array{0, 2, 2, 2, 2}));
    EXPECT_NEAR(fa1.spikes.front(), 0.332467, 1e-6);
    EXPECT_NEAR(fa1.spikes.back(), 0.821376, 1e-6);
}

/// With the printed sizes, I_A is too small to exceed the leak until the plateau ends (errata S10a), and FA-I's gains for rising and
/// falling force are 8 and 3 (S15).
TEST(Chips, WithThePrintedSizesFireDifferently) {
    const auto press = stimulus("press");
    const auto sa1 = run_chip("sa1.cir", press, {{"as_printed", 1}}), fa1 = run_chip("fa1.cir", press, {{"as_printed", 1}});
    EXPECT_GE(sa1.between(rise_start, hold_start), 3U);
    EXPECT_EQ(sa1.between(fall_start - 0.09, 1), 0U);
    const auto standard = run_chip("sa1.cir", press, {{"as_printed", 1}, {"hv_membrane", 0}});
    EXPECT_EQ(standard.between(hold_start + 0.05, 1), 0U);
    EXPECT_GT(fa1.between(rise_start, hold_start), 2 * fa1.between(fall_start, fall_end));
    EXPECT_GT(fa1.spikes.size(), 12U);
}

/// INVC's printed ratio raises the filters' corners by 18432 / 16000. The press is slower than these, so that a filter's current is nearly C
/// dV/dt with any ratio: it is larger by less than that, and decays earlier in the plateau.
TEST(Chips, AtTheLevelOfBlocksThePrintedRatioIsASetting) {
    const auto press = stimulus("press");
    const auto by_sizes = run_chip("sa1_macro.cir", press), fitted = run_chip("sa1_macro.cir", press, {{"fitted", 1}});
    const auto largest = [](const ChipRun& run) { return *std::max_element(run.probes_by_name.at("i(vib)").begin(), run.probes_by_name.at("i(vib)").end()); };
    EXPECT_GT(largest(fitted), largest(by_sizes));
    EXPECT_LT(largest(fitted), 1.1 * largest(by_sizes));
    const auto after_ramp = static_cast<std::size_t>(std::lround((hold_start + 0.1) * press.rate));
    const double ratio = fitted.probes_by_name.at("i(vic)")[after_ramp] / by_sizes.probes_by_name.at("i(vic)")[after_ramp];
    EXPECT_LT(ratio, 1);
}

/// Without length modulation and velocity saturation the mirrors divide by their ratios: 288 x 64 (eq. 38, 39; errata S7b).
TEST(Chips, TransconductorsDivideByTheirRatiosInThePlainModel) {
    const auto netlist = Netlist::read(corpuscle::test::source_root() + "/circuits/invc.cir");
    ASSERT_TRUE(netlist);
    auto circuit = netlist->elaborate();
    ASSERT_TRUE(circuit);
    for (auto& model : circuit->models) model.values["ve"] = 1e30, model.values["zetal"] = 0;
    EXPECT_NEAR(run_netlist(std::move(*circuit)).number("attenuation"), 18432, 0.005 * 18432);
}

/// The membrane falls from V_H to V_L, and a spike charges it again. It overshoots because of the trigger's delay (thesis 4.4).
TEST(Chips, MembranesStayBetweenTheTriggersThresholdsWhileTheyFire) {
    const auto trigger = run_netlist_file("schmitt.cir");
    const double V_L = trigger.number("v_l"), V_H = trigger.number("v_h");
    for (const char* file : {"sa1.cir", "fa1.cir"}) {
        auto stimulus_force = stimulus("press", {}, 100e3);
        const auto chip = run_chip(file, stimulus_force);
        const auto& u = chip.probes_by_name.at("v(u)");
        const auto sample = [&](double t) { return u.begin() + static_cast<std::ptrdiff_t>(std::lround(t * stimulus_force.rate)); };
        const auto [lowest, highest] = std::minmax_element(sample(chip.spikes[0]), sample(chip.spikes[chip.between(0, fall_start) - 1]));
        EXPECT_GT(*lowest, V_L - 2e-3) << file;
        EXPECT_LT(*lowest, V_L + 2e-3) << file;
        EXPECT_GT(*highest, V_H) << file << ": the trigger lags while the membrane is charged";
        EXPECT_LT(*highest, V_H + 15e-3) << file;
    }
}

/// "At each firing event the membrane potential u charges very fast, causing glitches in the input signal I" (thesis 4.4).
TEST(Chips, ChargingMakesGlitchesInTheCurrent) {
    const auto press = stimulus("press", {}, 100e3);
    const auto chip = run_chip("sa1.cir", press);
    const auto& current = chip.probes_by_name.at("i(vi)");
    const auto largest = [&](double from, double to) {
        const auto at = [&](double t) { return current.begin() + static_cast<std::ptrdiff_t>(t * press.rate); };
        return *std::max_element(at(from), at(to));
    };
    for (std::size_t k = 1; k + 1 < chip.between(0, fall_start); ++k) {
        const double t = chip.spikes[k];
        EXPECT_GT(largest(t, t + 2e-3), 1.3 * largest(t - 3e-3, t - 1e-3)) << t;
    }
}

/// Forces of 0.05 to 40 N, fast and slow: the solver always converges, and saturation is reported.
TEST(Chips, ConvergeUnderAnyForceAndReportSaturation) {
    for (const char* file : {"sa1.cir", "fa1.cir"}) {
        for (const double force : {0.05, 0.5, 10.0, 40.0}) {
            const auto press = run_chip(file, stimulus("press", {fmt::format("press.F_max={}", force)}));
            const auto step = run_chip(file, stimulus("step", {fmt::format("step.F_max={}", force), "step.t_hold=0.2", "step.t_rest=0.1"}));
            EXPECT_FALSE(press.error || step.error) << file << ' ' << force;
            EXPECT_EQ(press.outside[0].samples > 0, force > 6) << file << ' ' << force;
        }
        for (const double f : {1.0, 60.0, 500.0}) {
            const auto sine = run_chip(file, stimulus("sine", {fmt::format("sine.f={}", f), "sine.duration=0.1", "sine.F_mean=2"}, 20e3));
            EXPECT_FALSE(sine.error) << file << ' ' << f;
        }
    }
}

/// The force acts from the first sample on. At 1 N and more SA-I fires continuously, so it has no stable operating point.
TEST(Chips, StartUnderAnyInitialForce) {
    for (const char* file : {"sa1.cir", "fa1.cir"})
        for (const double celsius : {27.0, 85.0})
            for (const double force : {0.05, 0.3, 1.09, 2.5, 8.0, 40.0}) {
                const auto chip = run_chip(file, {.rate = 1e3, .samples = {std::vector<double>(30, force)}}, {}, celsius);
                EXPECT_FALSE(chip.error) << file << ' ' << force << " N, " << celsius << " C";
            }
    EXPECT_GT(run_chip("sa1.cir", {.rate = 1e3, .samples = {std::vector<double>(300, 4.0)}}).spikes.size(), 4U);
}

TEST(Chips, RestSilentlyForHours) {
    for (const char* file : {"sa1.cir", "fa1.cir"}) {
        const auto quiet = run_chip(file, stimulus("step", {"step.t_rest=600", "step.t_hold=0.3", "step.F_max=4"}, 100));
        EXPECT_FALSE(quiet.error);
        EXPECT_EQ(quiet.between(0, 600), 0U);
        EXPECT_GT(quiet.between(600, 600.3), 3U) << "responds after the rest";
    }
}

TEST(Chips, WorkWithADamagedSensor) {
    const auto press = stimulus("press");
    for (const char* file : {"sa1.cir", "fa1.cir"}) {
        const auto open = run_chip(file, press, {{"r_0", 1e15}, {"r_1gf", 1e15}});
        const auto shorted = run_chip(file, press, {{"r_0", 1}, {"r_1gf", 1}});
        EXPECT_FALSE(open.error || shorted.error);
        EXPECT_TRUE(open.spikes.empty()) << "no sensor current";
        EXPECT_GT(shorted.outside[1].samples, 9000) << "reported: the amplifier cannot hold the sensor's voltage";
    }
}

/// Tolerances a hundred times tighter move no spike by more than 0.2 ms.
TEST(Chips, SpikeTimesHardlyDependOnTheTolerances) {
    for (const std::string file : {"sa1.cir", "fa1.cir"}) {
        const auto folder = corpuscle::test::source_root() + "/circuits/";
        auto text = corpuscle::test::read_file(folder + file);
        text.replace(text.rfind(".end"), 4, ".options reltol=1e-7 vntol=1e-8 spikecheck=0\n.end");
        for (auto at = text.find("'parts/"); at != std::string::npos; at = text.find("'parts/", at + 1)) text.insert(at + 1, folder);
        const auto standard = spikes_of(run_netlist_file(file)), tight = spikes_of(run_netlist(text));
        ASSERT_EQ(standard.size(), tight.size());
        for (std::size_t k = 0; k < tight.size(); ++k) EXPECT_NEAR(standard[k], tight[k], 0.2e-3) << file << ' ' << k;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
