// Sweep files: sampled values, errors with their location, and results that do not depend on threads, processes or order.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <cstring>
#include <numeric>
#include <regex>
#include <set>

#include "circuit/run_directives.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "support/support.hpp"
#include "sweep/spec/probability.hpp"
#include "sweep/spec/sampling.hpp"
#include "sweep/spec/sweep.hpp"
#include "sweep/spec/sweep_text.hpp"

namespace corpuscle {
namespace {

using sweeps::Sampling;
using sweeps::UniformNumbers;

/// A sweep file in a temporary folder, with the files beside it.
class SweepFolder {
    test::TemporaryFolder folder_;

public:
    std::string path(const std::string& name) const { return folder_ / name; }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name);
    }
    std::unique_ptr<Sweep> sweep(const std::string& text, const std::string& name = "x.toml") const {
        return test::value_or_throw(read_sweep(write(name, text)));
    }
    /// "3:8: message"
    std::string refusal(const std::string& text) const {
        const auto read = read_sweep(write("x.toml", text));
        if (read) return "";
        auto message = read.error().text();
        if (const auto at = message.find("x.toml:"); at != std::string::npos) message = message.substr(at + 7);
        return message;
    }
};

using Outcomes = std::map<std::int64_t, ItemOutcome>;

/// The outcomes of these items, in one call.
Outcomes run_items(const Sweep& sweep, std::vector<std::int64_t> items) {
    Outcomes out;
    std::size_t at = 0;
    const auto next = [&]() -> std::optional<std::int64_t> { return at < items.size() ? std::optional(items[at++]) : std::nullopt; };
    const auto done = sweep.run_items(next, [&](ItemOutcome&& o) { out[o.item] = std::move(o); }, [] { return false; });
    EXPECT_TRUE(done) << done.error().text();
    return out;
}
Outcomes run_items(const Sweep& sweep) {
    std::vector<std::int64_t> all(static_cast<std::size_t>(sweep.item_count));
    std::iota(all.begin(), all.end(), 0);
    return run_items(sweep, all);
}

template <class T>
void expect_same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Compares the outcomes of one call for all items in order with those of several calls in reverse order.
void expect_the_same_outcomes_in_any_order(const Sweep& sweep) {
    const auto forward = run_items(sweep);
    ASSERT_EQ(forward.size(), static_cast<std::size_t>(sweep.item_count));
    Outcomes reversed;
    for (auto to = sweep.item_count; to > 0;) {
        const auto from = std::max<std::int64_t>(to - 3, 0);
        std::vector<std::int64_t> few;
        for (auto u = to; u-- > from;) few.push_back(u);
        reversed.merge(run_items(sweep, few));
        to = from;
    }
    for (const auto& [item, one] : forward) {
        const auto& other = reversed.at(item);
        EXPECT_EQ(one.end, other.end);
        expect_same_bytes(one.measures, other.measures);
        ASSERT_EQ(one.spikes.size(), other.spikes.size());
        for (std::size_t k = 0; k < one.spikes.size(); ++k) expect_same_bytes(one.spikes[k], other.spikes[k]);
        for (std::size_t k = 0; k < one.probes.size(); ++k) expect_same_bytes(one.probes[k], other.probes[k]);
    }
}

TEST(Sampling, ALatinHypercubeHasOneSampleInEachStratum) {
    for (const std::uint64_t n : {1, 2, 7, 64, 1000}) {
        const UniformNumbers one(Sampling::latin, 5, "a", 0, n), other(Sampling::latin, 5, "b", 0, n);
        std::set<std::uint64_t> strata;
        bool is_same_sequence = true;
        for (std::uint64_t k = 0; k < n; ++k) {
            const double u = one.at(k);
            ASSERT_GT(u, 0);
            ASSERT_LT(u, 1);
            strata.insert(static_cast<std::uint64_t>(u * static_cast<double>(n)));
            is_same_sequence = is_same_sequence && static_cast<int>(u * 7) == static_cast<int>(other.at(k) * 7);
        }
        EXPECT_EQ(strata.size(), n);
        EXPECT_TRUE(n <= 2 || !is_same_sequence) << "two axes are correlated";
    }
}

TEST(Sampling, SobolPointsAreThoseOfJoeAndKuo) {
    const double printed[8][3] = {{0, 0, 0},
                                  {0.5, 0.5, 0.5},
                                  {0.75, 0.25, 0.25},
                                  {0.25, 0.75, 0.75},
                                  {0.375, 0.375, 0.625},
                                  {0.875, 0.875, 0.125},
                                  {0.625, 0.125, 0.875},
                                  {0.125, 0.625, 0.375}};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto v = sweeps::sobol_directions(d);
        for (std::uint32_t k = 0; k < 8; ++k) EXPECT_EQ(sweeps::sobol_point(v, k) * 0x1p-32, printed[k][d]) << k << " " << d;
    }
    std::set<std::vector<std::uint32_t>> sequences;
    // Each of 256 equal intervals has one of these 256 points, and no two dimensions are equal.
    for (std::size_t d = 0; d < sweeps::sobol_dimensions; ++d) {
        const auto v = sweeps::sobol_directions(d);
        std::set<std::uint32_t> strata;
        std::vector<std::uint32_t> points;
        for (std::uint32_t k = 256; k < 512; ++k) points.push_back(sweeps::sobol_point(v, k)), strata.insert(points.back() >> 24);
        EXPECT_EQ(strata.size(), 256u) << d;
        EXPECT_TRUE(sequences.insert(points).second) << d;
    }
}

TEST(Sampling, NormalDeviatesHaveTheRightMomentsAndQuantiles) {
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
    EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-13);
    EXPECT_NEAR(normal_probability(-1), 0.15865525393145707, 1e-15);
    for (const auto sampling : {Sampling::random, Sampling::latin, Sampling::sobol}) {
        const UniformNumbers u(sampling, 3, "f_B", 4, 20000);
        double sum = 0, squares = 0, fourth = 0;
        for (std::uint64_t k = 0; k < 20000; ++k) {
            const double x = normal_quantile(u.at(k));
            sum += x / 20000, squares += x * x / 20000, fourth += x * x * x * x / 20000;
        }
        // In units of the standard error of the mean of 20000 random samples, 0.0071; the other sequences are more even.
        const double limit = sampling == Sampling::random ? 4 : 0.2;
        EXPECT_NEAR(sum, 0, limit * 0.0071);
        EXPECT_NEAR(squares, 1, limit * 0.01);
        EXPECT_NEAR(fourth, 3, limit * 0.07 + 0.02);
    }
}

TEST(SweepFile, ANormalAxisStaysWithinItsLimitsAndHasTheSameSamplesAtEachPoint) {
    const SweepFolder w;
    const auto s = w.sweep(
        "afferent = 'sa1'\nsamples = 200\nseed = 9\n[[vary]]\nwhat = 'press.F_max'\nlist = ['1N', 2]\n[[vary]]\nwhat = 'f_B'\nmean = "
        "'20Hz'\nsigma = '50%'\nat_least = '15Hz'\nat_most = '26Hz'\n");
    ASSERT_EQ(s->item_count, 400);
    std::set<double> seen;
    for (std::int64_t k = 0; k < 200; ++k) {
        const auto one = s->values(k), other = s->values(200 + k);
        EXPECT_EQ(one[0], 1);
        EXPECT_EQ(other[0], 2);
        EXPECT_EQ(one[1], other[1]);
        EXPECT_GE(one[1], 15);
        EXPECT_LE(one[1], 26);
        seen.insert(one[1]);
    }
    EXPECT_EQ(seen.size(), 200u);
    EXPECT_EQ(s->axes[1].unit, "Hz");
}

constexpr const char* netlist_with_step_and_mc =
    "Two dividers and a mirror\n.lib '../process/tsmc180.lib' mc\n.param r=1k supply=0.7\nvdd d 0 {supply}\nibias g 0 100n\n"
    "m1 g g d d pch w=6u l=0.5u m=2 stack=8\nm2 o g d d pch w=6u l=0.5u m=2 stack=8\nr1 o 0 {r*1k}\n.op\n.meas op out find v(o)\n"
    ".step param r list 1k 1.5k\n.step temp -40 85 62.5\n.mc 3 seed=11\n.end\n";

/// The measurements of `corpuscle run`, variant by variant.
std::vector<double> measured_values(const std::string& path) {
    auto variants = test::value_or_throw(circuit::NetlistVariants::create(test::value_or_throw(circuit::Netlist::read(path))));
    std::vector<double> out;
    std::unique_ptr<circuit::AnalysisContext> bench;
    for (std::size_t k = 0; k < variants.count(); ++k) {
        const auto variant = test::value_or_throw(variants.at(k));
        if (!bench || bench->circuit != variant.circuit) bench = test::value_or_throw(circuit::AnalysisContext::make(variant.circuit));
        if (variant.sample) bench->apply_variation(*variant.sample);
        out.push_back(*test::value_or_throw(circuit::run_directives(*bench)).find_number("out"));
    }
    return out;
}

std::vector<double> first_measures(const Sweep& sweep) {
    std::vector<double> out;
    for (const auto& [item, o] : run_items(sweep)) out.push_back(o.measures.at(0));
    return out;
}

TEST(SweepFile, StepAndMcOfANetlistGiveTheSameChipsAsASweepFile) {
    const SweepFolder w;
    std::filesystem::create_directories(w.path("process")), std::filesystem::create_directories(w.path("mine"));
    w.write("process/tsmc180.lib", test::read_file(test::source_root() + "/process/tsmc180.lib"));
    const auto path = w.write("mine/x.cir", netlist_with_step_and_mc);
    const auto expected = measured_values(path);
    ASSERT_EQ(expected.size(), 18u);
    EXPECT_EQ(std::set<double>(expected.begin(), expected.end()).size(), 18u);
    const auto of_netlist = test::value_or_throw(read_sweep(path));
    expect_same_bytes(first_measures(*of_netlist), expected);
    EXPECT_EQ(of_netlist->values(17)[0], 1.5e3);
    EXPECT_EQ(of_netlist->values(17)[1], 85);
    const std::string bare(netlist_with_step_and_mc, std::strstr(netlist_with_step_and_mc, ".step"));
    w.write("mine/bare.cir", bare);
    expect_same_bytes(
        first_measures(*w.sweep("netlist = 'mine/bare.cir'\nsamples = 3\nseed = 11\n[[vary]]\nwhat = 'r'\nlist = ['1k', '1.5kohm']\n"
                                "[[vary]]\nwhat = 'temp'\nfrom = -40\nto = '85C'\ncount = 3\n[[vary]]\nwhat = 'process'\n"
                                "[[vary]]\nwhat = 'mismatch'\n")),
        expected);
    // Settings of the sweep file override the netlist's, parameter by parameter.
    const auto fewer = w.sweep("netlist = 'mine/x.cir'\nsamples = 2\n[[vary]]\nwhat = 'temp'\nlist = [85]\n");
    expect_same_bytes(first_measures(*fewer), std::vector<double>{expected[6], expected[7], expected[15], expected[16]});
    for (const auto& f : fewer->metadata) {
        EXPECT_EQ(f.name.find(w.path("")), std::string::npos) << f.name;
        EXPECT_EQ(f.text.find(w.path("")), std::string::npos) << f.name;
    }
}

TEST(SweepFile, AnItemDoesNotDependOnItsProcessOrTheItemsBefore) {
    const SweepFolder w;
    expect_the_same_outcomes_in_any_order(
        *w.sweep("netlist = 'circuits/quiescent.cir'\nsamples = 40\nmeasures = ['v(qa)', 'i(visa)']\nset.corner = 'mc'\n"
                 "[[vary]]\nwhat = 'process'\n[[vary]]\nwhat = 'mismatch'\n"));
    expect_the_same_outcomes_in_any_order(
        *w.sweep("afferent = 'sa1'\nsamples = 100\n[[vary]]\nwhat = 'f_B'\nsigma = '5%'\nhow = 'latin'\n[[vary]]\n"
                 "what = 'press.t_hold'\nhow = 'uniform'\nfrom = '0.1s'\nto = '0.3s'\n"));
    expect_the_same_outcomes_in_any_order(
        *w.sweep("afferent = 'fsr+sa1'\nsamples = 4\ntraces = ['u']\nevery = '10ms'\n[[vary]]\nwhat = 'f_B'\nsigma = '5%'\n"));
}

TEST(SweepFile, ItemsOnLanesRespondAsScalarAfferentsDo) {
    const SweepFolder w;
    const auto s = w.sweep(
        "afferent = 'sa1'\nsamples = 70\n[[vary]]\nwhat = 'sa1.f_B'\nsigma = '10%'\n[[vary]]\nwhat = 'press.F_max'\nlist = [1, 3]\n");
    const auto all = run_items(*s);
    for (const std::int64_t item : {0, 69, 70, 139}) {
        const auto values = s->values(item);
        const auto expected =
            test::train("sa1", "press", {{fmt::format("sa1.f_B={}", values[0]), fmt::format("press.F_max={}", values[1])}});
        expect_same_bytes(all.at(item).spikes.at(0), expected);
        EXPECT_EQ(all.at(item).measures.at(0), static_cast<double>(expected.size()));
    }
}

TEST(SweepFile, ChipsOfANetlistHaveTheSameSamplesInEveryDesign) {
    const SweepFolder w;
    const std::string chip =
        "A relaxer\n.lib '../process/tsmc180.lib' tt\n.param c=10n\niin 0 a dc 0.1u force 1u\nca a 0 {c}\n"
        "b1 a 0 i={1m*v(a)*0.5*(1+tanh((v(s)-0.5)*20))}\nb2 t 0 v={0.5*(1+tanh((v(a)-1+0.8*v(s))*20))}\nr2 t s 1k\n"
        "c2 s 0 10n\nm1 a 0 0 0 nch w=50u l=1u\n.spike v(s) 0.5\n.tran 1m 1 0 5m uic\n.end\n";
    std::filesystem::create_directories(w.path("process")), std::filesystem::create_directories(w.path("mine"));
    w.write("process/tsmc180.lib", test::read_file(test::source_root() + "/process/tsmc180.lib"));
    w.write("mine/x.cir", chip);
    const std::string head =
        "afferent = 'mine/x.cir'\nforce = 'step'\nrate = '1kHz'\nsamples = 3\ntraces = ['a']\n"
        "measures = ['spikes', 'spikes.hold', 'first_spike', 'power']\n[set]\nstep.t_rest = '10ms'\nstep.t_hold = '50ms'\n"
        "step.t_post = '10ms'\n[[vary]]\nwhat = 'mismatch'\n";
    const auto plain = w.sweep(head), wider = w.sweep(head + "[[vary]]\nwhat = 'c'\nlist = ['10nF', '20nF']\n");
    const auto one = run_items(*plain), more = run_items(*wider);
    for (std::int64_t item = 0; item < 3; ++item) {
        ASSERT_GT(one.at(item).spikes.at(0).size(), 3u) << one.at(item).reason;
        expect_same_bytes(one.at(item).spikes[0], more.at(item).spikes.at(0));
        expect_same_bytes(one.at(item).measures, more.at(item).measures);
        EXPECT_LT(more.at(3 + item).spikes.at(0).size(), one.at(item).spikes[0].size());
        EXPECT_EQ(one.at(item).probes.at(0).size(), plain->probe_times.size());
    }
    EXPECT_NE(one.at(0).spikes[0], one.at(1).spikes[0]);
    EXPECT_EQ(run_items(*w.sweep("iterations = 20\n" + head)).at(2).end, ItemEnd::iteration_limit);
    EXPECT_EQ(plain->metadata.back().name, "drawn");
    expect_the_same_outcomes_in_any_order(*wider);
}

TEST(SweepFile, ALimitIsTwoNumbersOrTheModelsMeasureUnderTheSameForce) {
    const SweepFolder w;
    const auto s = w.sweep(
        "afferent = 'sa1b+lif-b'\nmeasures = ['first_spike']\n[limits]\nspikes = {like = 'sa1', within = 3}\nfirst_spike = "
        "{at_most = '320ms'}\npeak_rate.plateau = ['1Hz', '1kHz']\nlast_spike = {like = 'sa1', within = '10%'}\n");
    const auto model = test::train("sa1");
    std::map<std::string, SweepColumn> columns;
    for (const auto& c : s->measures) columns[c.name] = c;
    EXPECT_EQ(s->measures[0].name, "first_spike");
    EXPECT_EQ(columns.at("spikes").min, static_cast<double>(model.size()) - 3);
    EXPECT_EQ(columns.at("spikes").max, static_cast<double>(model.size()) + 3);
    EXPECT_FALSE(columns.at("first_spike").min);
    EXPECT_EQ(columns.at("first_spike").max, 0.32);
    EXPECT_EQ(columns.at("peak_rate.plateau").max, 1000);
    EXPECT_DOUBLE_EQ(*columns.at("last_spike").min, 0.9 * model.back());
}

TEST(SweepFile, ErrorsGiveTheLocationAndTheRemedy) {
    const SweepFolder w;
    const std::pair<const char*, const char*> wrong[] = {
        {"afferent = 'sa1'\nunit = 3\n[[vari]]\n", "3:3: there is no 'vari'; did you mean 'vary'?"},
        {"afferent = sa1\n", "1:12: "},
        {"afferent = 'sa3'\n", "1:12: unknown afferent 'sa3'"},
        {"samples = 3\n", "the sweep has no subject"},
        {"afferent = 'sa1'\nnetlist = 'x.cir'\n", "2:11: give either afferent"},
        {"netlist = 'circuits/bais.cir'\n",
         "1:11: there is no netlist 'circuits/bais.cir' in the folder of the sweep file and no embedded one "
         "of this name; did you mean 'circuits/bias.cir'?"},
        {"afferent = 'sa1'\nsamples = 2.5\n[[vary]]\nwhat = 'f_B'\nsigma = '5%'\n", "2:11: samples = 2.5 must be an integer"},
        {"afferent = 'sa1'\nsamples = [1]\n", "2:11: samples is a list; expected a text or a number"},
        {"afferent = 'sa1'\nsamples = 5\n", "2:11: samples = 5, but nothing is sampled"},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nsigma = '5%'\n", "3:8: f_B is sampled, but the number of samples is missing"},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_BB'\nlist = [1]\n", "3:8: sa1: unknown parameter 'f_BB'; did you mean 'f_B'?"},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nlist = ['20Hz', '-3Hz']\n", "4:17: f_B: -3 Hz is outside ["},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nlist = ['20V']\n", "4:9: f_B: "},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nfrom = 1\nto = 2\n", "3:8: f_B: count is missing"},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nfrom = 1\ncount = 2\n", "3:8: f_B: to is missing"},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nhow = 'sobl'\n", "4:7: f_B: how = \"sobl\" is unknown; did you mean 'sobol'?"},
        {"afferent = 'sa1'\n[[vary]]\nwhat = 'f_B'\nlist = [1]\nsigma = 2\n", "5:9: f_B: 'sigma' has no meaning for how = \"list\""},
        {"afferent = 'sa1'\n[[vary]]\nlist = [1]\n", "2:1: [[vary]]: 'what' is missing"},
        {"afferent = 'sa1'\nsamples = 2\n[[vary]]\nwhat = 'process'\n", "4:8: sa1 is a model; 'process' applies to the chips of a circuit"},
        {"afferent = 'sa1'\nset.press.F_mox = 2\n", "2:19: press: unknown parameter 'F_mox'; did you mean 'F_m"},
        {"afferent = 'sa1'\nmeasures = ['spikes', 'spikes.plato']\n",
         "2:23: unknown measure 'spikes.plato'; did you mean 'spikes.plateau'?"},
        {"afferent = 'sa1'\n[limits]\nspiks = [1, 2]\n", "3:1: unknown measure 'spiks'; did you mean 'spikes'?"},
        {"afferent = 'sa1'\n[limits]\nspikes = [3, 2]\n", "3:11: spikes: at_least is above at_most"},
        {"afferent = 'sa1'\n[limits]\nspikes = {lik = 'sa1'}\n", "3:11: spikes: there is no 'lik'; did you mean 'like'?"},
        {"afferent = 'sa1'\nforce = 'pres'\n", "2:9: unknown stimulus 'pres'; did you mean 'press'? (and there is no file 'pres')"},
        {"afferent = 'sa1'\ntraces = ['w']\n", "2:11: traces: sa1 has no 'w'"},
        {"netlist = 'circuits/bias.cir'\n[[vary]]\nwhat = 'suply'\nlist = [1]\n",
         "3:8: suply: circuits/bias.cir has no parameter or device 'suply'; "
         "did you mean 'supply'?"},
        {"netlist = 'circuits/bias.cir'\n[[vary]]\nwhat = 'corner'\nlist = ['tt', 'sx']\n", "4:15: "},
        {"netlist = 'circuits/bias.cir'\nmeasures = ['v(qq)']\n", "2:13: the netlist has no number 'v(qq)'; did you mean 'v(q)'?"},
        {"netlist = 'circuits/bias.cir'\nsamples = 2\nset.mismatch = 7\n[[vary]]\nwhat = 'mismatch'\n", "[set] selects one chip"},
    };
    for (const auto& [text, expected] : wrong) {
        const auto message = w.refusal(text);
        EXPECT_NE(message.find(expected), std::string::npos) << text << "\n  says  " << message << "\n  not   " << expected;
    }
}

TEST(SweepFile, MismatchOfANetlistInWhichNothingVariesIsRefused) {
    const SweepFolder w;
    const std::string netlist = "level 1\nv1 a 0 1\nm1 a a 0 0 n w=1u l=1u\n.model n nmos (level=1)\n.op\n";
    w.write("own.cir", netlist);
    const std::string sweep = "netlist = 'own.cir'\nsamples = 2\nmeasures = ['i(v1)']\n[[vary]]\nwhat = 'mismatch'\n";
    EXPECT_EQ(
        w.refusal(sweep),
        "5:8: mismatch: nothing in the netlist varies, so all chips would be equal: it has no UICM transistor (level=80), no tolerance "
        "and no random value; remove this axis");
    w.write("own.cir", netlist + "r1 a 0 {agauss(1k,10,1)}\n");
    EXPECT_EQ(w.refusal(sweep), "");
}

TEST(SweepFile, RenamedKeysAreRefusedWithTheirNewNames) {
    const SweepFolder w;
    for (const auto& [old_key, new_key] : sweeps::renamed_keys)
        EXPECT_NE(w.refusal(fmt::format("afferent = 'sa1'\n  {} = 3\n", old_key)).find(fmt::format("2:3: {} is now {}", old_key, new_key)),
                  std::string::npos)
            << old_key;
}

TEST(SweepFile, TheLayoutOfTheTextDoesNotMatter) {
    const SweepFolder w;
    const auto a = w.sweep("# one\nsamples = 3\nafferent = 'sa1'\n[set]\n'press.F_max' = 2\n[[vary]]\nwhat = 'f_B'\nsigma = '5%'\n");
    const auto b =
        w.sweep("afferent   = \"sa1\"  # two\nsamples = 3\nset = {'press.F_max' = 2}\n\n[[vary]]\nsigma = '5%'\nwhat = 'f_B'\n", "y.toml");
    ASSERT_EQ(a->metadata.size(), b->metadata.size());
    for (std::size_t k = 0; k < a->metadata.size(); ++k) EXPECT_EQ(a->metadata[k].text, b->metadata[k].text) << a->metadata[k].name;
    const auto c = w.sweep("afferent = 'sa1'\nsamples = 3\n[set]\n'press.F_max' = 3\n[[vary]]\nwhat = 'f_B'\nsigma = '5%'\n");
    EXPECT_NE(a->metadata.at(2).text, c->metadata.at(2).text);
}

/// The examples, with few items.
TEST(SweepFile, TheExamplesRun) {
    const SweepFolder w;
    int count = 0;
    for (const auto& file : std::filesystem::directory_iterator(test::source_root() + "/examples/sweeps")) {
        const auto complete = test::read_file(file.path().string());
        EXPECT_GT(test::value_or_throw(read_sweep(file.path().string()))->item_count, 50);
        const auto s = w.sweep(std::regex_replace(complete, std::regex("samples( *)= [0-9]+"), "samples = 2"));
        const auto all = run_items(*s, {0, s->item_count - 1});
        for (const auto& [item, o] : all) {
            EXPECT_EQ(o.end, ItemEnd::done) << file.path() << o.reason;
            EXPECT_TRUE(std::isfinite(o.measures.at(0))) << file.path();
        }
        EXPECT_EQ(all.size(), 2u);
        ++count;
    }
    EXPECT_GE(count, 5);
}

}  // namespace
}  // namespace corpuscle
