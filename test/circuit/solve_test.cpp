// Operating points: if a circuit has one, it is found; otherwise the error gives the reason.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include "circuit/device/named_values.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/run_directives.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "core/number/instruction_set.hpp"
#include "support/test_paths.hpp"

namespace corpuscle::circuit {
namespace {

Netlist netlist_of(const std::string& text) {
    auto netlist = Netlist::parse(text, test::source_root() + "/process/test.cir", [](const std::string& path) -> Result<std::string> {
        std::FILE* file = std::fopen(path.c_str(), "rb");
        if (file == nullptr) return bad_input("no file " + path);
        std::string out(100000, '\0');
        out.resize(std::fread(out.data(), 1, out.size(), file));
        std::fclose(file);
        return out;
    });
    EXPECT_TRUE(netlist) << netlist.error().text();
    return std::move(*netlist);
}

std::unique_ptr<AnalysisContext> solve_context(const std::string& text) {
    auto circuit = netlist_of(text).elaborate();
    EXPECT_TRUE(circuit) << circuit.error().text();
    auto context = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
    EXPECT_TRUE(context) << context.error().text();
    return std::move(*context);
}

Result<RunOutcome> run_text(const std::string& text, std::shared_ptr<const Circuit>* circuit_out = nullptr) {
    auto circuit = netlist_of(text).elaborate();
    if (!circuit) return circuit.error();
    static std::vector<std::shared_ptr<const Circuit>> all;  // an outcome points to the commands of its circuit
    all.push_back(std::make_shared<const Circuit>(std::move(*circuit)));
    if (circuit_out != nullptr) *circuit_out = all.back();
    return run_directives(all.back());
}

double curve_value(const RunOutcome& outcome, const std::string& name) {
    return outcome.analyses[0].result.plots[0].find_curve(name)->values[0].real();
}

std::string solve_error(const std::string& text) {
    const auto outcome = run_text(text);
    EXPECT_FALSE(outcome) << text;
    return outcome ? "" : outcome.error().text();
}

TEST(Topology, UnsolvableNetlistsAreRejectedWithLineAndReason) {
    const auto has = [](const std::string& message, std::initializer_list<const char*> words) {
        for (const char* w : words) EXPECT_NE(message.find(w), std::string::npos) << message << "\nlacks: " << w;
    };
    has(solve_error("t\nv1 a 0 1\nr1 a 0 1k\nc1 a b 1n\nc2 b 0 1n\n.op\n"), {"test.cir:4", "'b'", "no path to ground", "c1, c2"});
    has(solve_error("t\nv1 a 0 1\nr1 a 0 1k\ni1 0 b 1m\ni2 b 0 1m\n.op\n"), {"test.cir:4", "'b'", "current sources"});
    has(solve_error("t\nv1 a 0 1\nv2 a 0 2\nr1 a 0 1k\n.op\n"), {"test.cir:3", "v2", "v1", "loop"});
    has(solve_error("t\nv1 a 0 1\nl1 a a 1m\nr1 a 0 1k\n.op\n"), {"test.cir:3", "l1", "both ends"});
    has(solve_error("t\nr1 a b 1k\nr2 b a 1k\nv1 a b 1\n.op\n"), {"ground"});
    has(solve_error("t\nv1 a 0 1\nr1 a b 1k\nm1 b g 0 0 n\n.model n nmos(level=80)\n.op\n"), {"'g'", "no path to ground"});
    has(solve_error("t\nv1 a 0 1\nr1 a 0 1k\nm1 a a 0 0 n\n.model n nmos(level=2)\n.op\n"),
        {"test.cir:4", "level=1 (SPICE level 1)", "80 (UICM)"});
    has(solve_error("t\nv1 a 0 1\nr1 a 0 1k\n"), {"no analysis", ".op"});
    has(solve_error("t\nv1 a 0 1\nr1 a 0 1k\n.dc vx 0 1 0.1\n"), {"test.cir:4", "vx"});
    has(solve_error("t\nv1 a 0 1\nr1 a 0 1k\n.dc v1 0 1 -0.1\n"), {"test.cir:4", "step"});
    has(solve_error("t\nv1 a 0 1\nd1 a 0 dx\n.model dx d(isx=1)\n.op\n"), {"test.cir:4", "isx"});
}

TEST(Topology, AMistypedNodeIsReported) {
    const auto outcome = run_text("t\nv1 in 0 1\nr1 in out 1k\nr2 out 0 1k\nr3 ouy 0 1k\n.op\n");
    ASSERT_TRUE(outcome);
    ASSERT_EQ(outcome->warnings.size(), 1U);
    EXPECT_NE(outcome->warnings[0].text().find("test.cir:5:1: node 'ouy' is connected only to r3; did you mean 'out'?"), std::string::npos)
        << outcome->warnings[0].text();
}

TEST(Topology, TheFirstTwentyOfManyDanglingNodesHaveASuggestion) {
    std::string text = "t\nv1 node00 0 1\nr1 node00 0 1k\n";
    for (int k = 10; k < 35; ++k) text += fmt::format("r{} node{} 0 1k\n", k, k);
    const auto outcome = run_text(text + ".op\n");
    ASSERT_TRUE(outcome);
    ASSERT_EQ(outcome->warnings.size(), 25U);
    for (std::size_t k = 0; k < 25; ++k) EXPECT_EQ(outcome->warnings[k].text().ends_with("; did you mean 'node00'?"), k < 20) << k;
}

TEST(OperatingPoint, ADiodeFollowsItsEquation) {
    const auto outcome = run_text("t\ni1 0 a 1m\nd1 a 0 dx\n.model dx d(is=1e-15 n=1.5)\n.options gmin=0\n.op\n");
    ASSERT_TRUE(outcome);
    const double v_t = 1.380649e-23 * 300.15 / 1.602176634e-19;
    EXPECT_NEAR(curve_value(*outcome, "v(a)"), 1.5 * v_t * std::log(1e-3 / 1e-15 + 1), 1e-9);
}

TEST(OperatingPoint, PicoamperesAreResolved) {
    const auto outcome =
        run_text("t\ni1 0 a 3p\nm1 a a 0 0 n w=1.5u l=0.5u stack=8\n.model n nmos(level=80 isq=112n vto=0.46 n=1.27)\n.op\n");
    ASSERT_TRUE(outcome);
    const auto ten = run_text("t\ni1 0 a 30p\nm1 a a 0 0 n w=1.5u l=0.5u stack=8\n.model n nmos(level=80 isq=112n vto=0.46 n=1.27)\n.op\n");
    ASSERT_TRUE(ten);
    const double v_t = 1.380649e-23 * 300.15 / 1.602176634e-19;
    EXPECT_NEAR(curve_value(*ten, "v(a)") - curve_value(*outcome, "v(a)"), 1.27 * v_t * std::log(10.0),
                2e-3);  // weak inversion: n phi_t per factor e
}

TEST(OperatingPoint, TheSmallestDefaultOfGminOfAllKindsApplies) {
    const std::string diode = "gmin\nv1 a 0 0\nd1 a 0 m\n.model m d(is=1e-14)\n", ekv = "m1 a 0 0 0 n\n.model n nmos(level=55)\n";
    EXPECT_EQ(solve_context(diode + ".op\n")->tolerances.gmin, 1e-12);
    EXPECT_EQ(solve_context(diode + ekv + ".op\n")->tolerances.gmin, 1e-15);
    EXPECT_EQ(solve_context(diode + ekv + ".options gmin=1e-13\n.op\n")->tolerances.gmin, 1e-13);
}

TEST(OperatingPoint, ALatchRestsInTheStateOfItsNodeset) {
    const std::string latch =
        "t\n.lib 'tsmc180.lib' tt\nvdd v 0 0.7\nmp1 a b v v pch w=6u l=0.5u\nmn1 a b 0 0 nch w=1.5u l=0.5u\nmp2 b a v v pch w=6u "
        "l=0.5u\nmn2 b a 0 0 "
        "nch w=1.5u l=0.5u\n";
    for (const double side : {0.0, 0.7}) {
        const auto outcome = run_text(latch + fmt::format(".nodeset v(a)={} v(b)={}\n.op\n", side, 0.7 - side));
        ASSERT_TRUE(outcome) << outcome.error().text();
        EXPECT_NEAR(curve_value(*outcome, "v(a)"), side, 0.02);
        EXPECT_NEAR(curve_value(*outcome, "v(b)"), 0.7 - side, 0.02);
    }
}

/// A random solvable netlist: a ladder of resistors and diodes, mirrors, a chain of inverters, or an even ring of inverters.
std::string random_netlist(unsigned seed) {
    std::mt19937 generator(seed);
    const auto random_below = [&](unsigned n) { return static_cast<unsigned>(generator() % n); };
    const auto log_between = [&](double a, double b) { return a * std::pow(b / a, static_cast<double>(generator()) / 4294967295.0); };
    std::string text = fmt::format("netlist {}\n.lib 'tsmc180.lib' tt\nvdd v 0 {:.3f}\n", seed, log_between(0.4, 1.8));
    const unsigned kind = random_below(4), length = 1 + random_below(12);
    if (kind == 0) {
        std::string node = "v";
        for (unsigned k = 0; k < length; ++k) {
            const auto next = fmt::format("n{}", k);
            text += fmt::format("r{} {} {} {:.3g}\n", k, node, next, log_between(1, 1e9));
            text += random_below(2) ? fmt::format("d{} {} 0 dx {:.2g}\n", k, next, log_between(0.1, 10))
                                    : fmt::format("rs{} {} 0 {:.3g}\n", k, next, log_between(10, 1e9));
            node = next;
        }
        text += fmt::format(".model dx d(is={:.3g} n={:.3g})\n", log_between(1e-18, 1e-12), log_between(1, 2));
    }
    if (kind == 1) {
        text += fmt::format("i0 v g0 {:.3g}\n", log_between(1e-12, 1e-5));
        for (unsigned k = 0; k < length; ++k) {
            const char* model = k % 2 ? "pch" : "nch";
            const char* rail = k % 2 ? "v" : "0";
            text += fmt::format("ma{0} g{0} g{0} {1} {1} {2} w=1.5u l=0.5u m={3} stack={4}\n", k, rail, model, 1 + random_below(8),
                                1 + random_below(8));
            text += fmt::format("mb{0} g{5} g{0} {1} {1} {2} w=1.5u l=0.5u m={3} stack={4}\n", k, rail, model, 1 + random_below(8),
                                1 + random_below(8), k + 1);
        }
        text += fmt::format("ml g{0} g{0} {1} {1} {2} w=1.5u l=0.5u\n", length, length % 2 ? "v" : "0", length % 2 ? "pch" : "nch");
    }
    if (kind >= 2) {  // 3: the last inverter drives the first
        if (kind == 2) text += fmt::format("vin n0 0 {:.3f}\n", log_between(0.01, 0.7));
        const unsigned count = kind == 3 ? length + length % 2 : length;  // an even ring latches
        for (unsigned k = 0; k < count; ++k) {
            const auto out = kind == 3 && k + 1 == count ? std::string("n0") : fmt::format("n{}", k + 1);
            text += fmt::format("mp{0} {1} n{0} v v pch w=6u l=0.5u stack={2}\nmn{0} {1} n{0} 0 0 nch w=1.5u l=0.5u m={3}\n", k, out,
                                1 + random_below(8), 1 + random_below(4));
        }
    }
    return text + ".op\n";
}

TEST(OperatingPoint, OfAThousandRandomNetlistsAreFoundAndSatisfyTheEquations) {
    int by_newton = 0;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        const auto text = random_netlist(seed);
        std::shared_ptr<const Circuit> circuit;
        const auto outcome = run_text(text, &circuit);
        ASSERT_TRUE(outcome) << outcome.error().text() << "\n" << text;
        by_newton += outcome->analyses[0].result.table.find("found by newton") != std::string::npos;
        const auto system = System::make(circuit);
        ASSERT_TRUE(system);
        std::vector<double> x;
        for (const auto& c : outcome->analyses[0].result.plots[0].curves) x.push_back(c.values[0].real());
        SystemEvaluation evaluation;
        auto memory = system->initial_limiting_state();
        EvalContext eval_context;
        eval_context.gmin = (*AnalysisContext::make(circuit))->tolerances.gmin;
        do system->eval(x, eval_context, memory, evaluation);
        while (evaluation.is_limited);
        for (std::size_t n = 0; n < x.size(); ++n)
            ASSERT_LE(std::abs(evaluation.f[n]), 1e-6 * evaluation.scale[n] + 1e-16) << system->names()[n] << " of\n" << text;
    }
    EXPECT_GT(by_newton, 500);
}

TEST(NetlistVariants, SampleKDoesNotDependOnOtherSamples) {
    const auto netlist = [](int count) {
        return netlist_of(
            fmt::format("t\ni1 0 a 1n\nm1 a a 0 0 n w=1u l=1u\n.model n nmos(level=80 avt=3e-9 svt0=10m)\n.mc {} seed=4\n.op\n", count));
    };
    auto a = NetlistVariants::create(netlist(3)), b = NetlistVariants::create(netlist(7));
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->count(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto one = a->at(k), other = b->at(k);
        ASSERT_TRUE(one && other);
        EXPECT_EQ(one->sample->chip, k);
        EXPECT_EQ(one->sample->seed, other->sample->seed);
        for (int d = 0; d < 4; ++d) EXPECT_EQ(one->sample->process[d], other->sample->process[d]);
    }
}

/// A mirror and an inverter of four mismatched transistors; `extra_parameters` are appended to their lines.
std::string four_transistors(const std::array<std::string, 4>& extra_parameters) {
    return fmt::format(
        "t\nv1 v 0 0.7\ni1 v a 20n\nm1 a a 0 0 n w=2u l=1u{}\nm2 b a 0 0 n w=2u l=1u{}\nm3 b b v v p w=6u l=1u{}\nm4 c b v v p w=6u "
        "l=1u{}\n"
        "r1 c 0 10meg\n.model n nmos(level=80 avt=3e-9 ais=1e-8 svt0=10m zetal=0.02u)\n"
        ".model p pmos(level=80 isq=28n avt=4e-9 ais=1e-8 svt0=10m)\n.op\n",
        extra_parameters[0], extra_parameters[1], extra_parameters[2], extra_parameters[3]);
}

TEST(Chips, RestLikeANetlistWithTheSameMismatchAsParameters) {
    auto sampled = solve_context(four_transistors({}));
    const auto& circuit = *sampled->circuit;
    for (std::uint64_t chip = 0; chip < 50; ++chip) {
        ChipSample sample{9, chip, true, {}};
        sample.process = sample_process(9, chip);
        sampled->apply_variation(sample);
        std::array<std::string, 4> extra_parameters;
        std::uint32_t device = 0;
        for (const auto& e : circuit.elements) {
            if (e.letter != 'm') continue;
            const auto& model = circuit.models[static_cast<std::size_t>(e.model)];
            static constexpr std::string_view others[] = {"level"};
            const auto card = *read_model_card<UicmCard>(UicmCard::fields, model, others);
            UicmInstance size;
            size.W = e.values.at("w"), size.L = e.values.at("l");
            const auto own = sample_mismatch(card, size, 9, device, chip), all = process_shift(card, model.type == "pmos", sample.process);
            extra_parameters[device++] = fmt::format(" delvto={:.17g} mulu0={:.17g}", own.V_T + all.V_T, own.factor);
        }
        const auto written = solve_context(four_transistors(extra_parameters));
        const auto a = sampled->operating_point(), b = written->operating_point();
        ASSERT_TRUE(a && b);
        for (std::size_t n = 0; n < a->x.size(); ++n) EXPECT_NEAR(a->x[n], b->x[n], 1e-5 * std::abs(b->x[n])) << n;
    }
}

TEST(Chips, RestAtIdenticalVoltagesOnEveryInstructionSet) {
    const char* const before = std::getenv("CORPUSCLE_ISA");
    const std::string previous = before ? before : "";
    std::vector<std::vector<double>> first;
    for (const auto set : instruction_sets()) {
        ::setenv("CORPUSCLE_ISA", std::string(name_of(set)).c_str(), 1);
        auto context = solve_context(four_transistors({}));
        for (std::uint64_t chip = 0; chip < 20; ++chip) {
            context->apply_variation({9, chip, true, {}});
            const auto rest = context->operating_point();
            ASSERT_TRUE(rest);
            if (first.size() <= chip) first.push_back(rest->x);
            EXPECT_EQ(rest->x, first[chip]) << name_of(set) << ", chip " << chip;
        }
    }
    before ? ::setenv("CORPUSCLE_ISA", previous.c_str(), 1) : ::unsetenv("CORPUSCLE_ISA");
}

TEST(NetlistVariants, ABillionStepsAreRejectedImmediately) {
    const auto netlist = Netlist::parse("t\n.param r=1\nv1 a 0 1\nr1 a 0 {r}\n.step param r 1 1g 1\n.op\n", "t.cir",
                                        [](const std::string&) -> Result<std::string> { return bad_input("none"); });
    ASSERT_TRUE(netlist);
    const auto variants = NetlistVariants::create(*netlist);
    ASSERT_FALSE(variants);
    EXPECT_NE(variants.error().text().find("t.cir:5"), std::string::npos) << variants.error().text();
}

}  // namespace
}  // namespace corpuscle::circuit
