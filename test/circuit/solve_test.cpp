// Operating points: found wherever there is one, and where there is none the reason why.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <random>

#include "circuit/run.hpp"
#include "circuit/variants.hpp"

namespace corpuscle::circuit {
namespace {

Result<RunOutcome> run_text(const std::string& text, std::shared_ptr<const Circuit>* kept = nullptr) {
    const auto netlist = Netlist::parse(text, CORPUSCLE_ROOT "/process/test.cir", [](const std::string& path) -> Result<std::string> {
        std::FILE* file = std::fopen(path.c_str(), "rb");
        if (file == nullptr) return bad_input("no file " + path);
        std::string out(100000, '\0');
        out.resize(std::fread(out.data(), 1, out.size(), file));
        std::fclose(file);
        return out;
    });
    if (!netlist) return netlist.error();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error();
    static std::vector<std::shared_ptr<const Circuit>> all;  // an outcome points at its circuit's commands
    all.push_back(std::make_shared<const Circuit>(std::move(*circuit)));
    if (kept != nullptr) *kept = all.back();
    return run(all.back());
}

double found(const RunOutcome& outcome, const std::string& name) {
    return outcome.analyses[0].findings.plots[0].curve(name)->values[0].real();
}

std::string refusal(const std::string& text) {
    const auto outcome = run_text(text);
    EXPECT_FALSE(outcome) << text;
    return outcome ? "" : outcome.error().text();
}

TEST(Topology, WhatHasNoAnswerIsRefusedWithItsLineAndWhy) {
    const auto has = [](const std::string& said, std::initializer_list<const char*> words) {
        for (const char* w : words) EXPECT_NE(said.find(w), std::string::npos) << said << "\nlacks: " << w;
    };
    has(refusal("t\nv1 a 0 1\nr1 a 0 1k\nc1 a b 1n\nc2 b 0 1n\n.op\n"), {"test.cir:4", "'b'", "no path to ground", "c1, c2"});
    has(refusal("t\nv1 a 0 1\nr1 a 0 1k\ni1 0 b 1m\ni2 b 0 1m\n.op\n"), {"test.cir:4", "'b'", "current sources"});
    has(refusal("t\nv1 a 0 1\nv2 a 0 2\nr1 a 0 1k\n.op\n"), {"test.cir:3", "v2", "v1", "loop"});
    has(refusal("t\nv1 a 0 1\nl1 a 0 1m\nr1 a 0 1k\n.op\n"), {"test.cir:3", "l1", "loop"});
    has(refusal("t\nr1 a b 1k\nr2 b a 1k\nv1 a b 1\n.op\n"), {"ground"});
    has(refusal("t\nv1 a 0 1\nr1 a b 1k\nm1 b g 0 0 n\n.model n nmos(level=80)\n.op\n"), {"'g'", "no path to ground"});
    has(refusal("t\nv1 a 0 1\nr1 a 0 1k\nm1 a a 0 0 n\n.model n nmos(level=1)\n.op\n"), {"test.cir:5", "level=80"});
    has(refusal("t\nv1 a 0 1\nr1 a 0 1k\n"), {"no analysis", ".op"});
    has(refusal("t\nv1 a 0 1\nr1 a 0 1k\n.dc vx 0 1 0.1\n"), {"test.cir:4", "vx"});
    has(refusal("t\nv1 a 0 1\nr1 a 0 1k\n.dc v1 0 1 -0.1\n"), {"test.cir:4", "step"});
    has(refusal("t\nv1 a 0 1\nd1 a 0 dx\n.model dx d(isx=1)\n.op\n"), {"test.cir:4", "isx"});
}

TEST(Topology, AMistypedNodeIsTold) {
    const auto outcome = run_text("t\nv1 in 0 1\nr1 in out 1k\nr2 out 0 1k\nr3 ouy 0 1k\n.op\n");
    ASSERT_TRUE(outcome);
    ASSERT_EQ(outcome->remarks.size(), 1U);
    EXPECT_NE(outcome->remarks[0].text().find("test.cir:5:1: node 'ouy' stands at r3 alone; did you mean 'out'?"), std::string::npos)
        << outcome->remarks[0].text();
}

TEST(OperatingPoint, ADiodeCarriesWhatItsEquationSays) {
    const auto outcome = run_text("t\ni1 0 a 1m\nd1 a 0 dx\n.model dx d(is=1e-15 n=1.5)\n.options gmin=0\n.op\n");
    ASSERT_TRUE(outcome);
    const double v_t = 1.380649e-23 * 300.15 / 1.602176634e-19;
    EXPECT_NEAR(found(*outcome, "v(a)"), 1.5 * v_t * std::log(1e-3 / 1e-15 + 1), 1e-9);
}

TEST(OperatingPoint, PicoamperesAreNotLost) {
    const auto outcome =
        run_text("t\ni1 0 a 3p\nm1 a a 0 0 n w=1.5u l=0.5u stack=8\n.model n nmos(level=80 isq=112n vto=0.46 n=1.27)\n.op\n");
    ASSERT_TRUE(outcome);
    const auto ten = run_text("t\ni1 0 a 30p\nm1 a a 0 0 n w=1.5u l=0.5u stack=8\n.model n nmos(level=80 isq=112n vto=0.46 n=1.27)\n.op\n");
    ASSERT_TRUE(ten);
    const double v_t = 1.380649e-23 * 300.15 / 1.602176634e-19;
    EXPECT_NEAR(found(*ten, "v(a)") - found(*outcome, "v(a)"), 1.27 * v_t * std::log(10.0), 2e-3);  // weak inversion: n phi_t a factor e
}

TEST(OperatingPoint, ALatchHasMoreThanOneAndSaysSo) {
    const std::string latch =
        "t\n.lib 'tsmc180.lib' tt\nvdd v 0 0.7\nmp1 a b v v pch w=6u l=0.5u\nmn1 a b 0 0 nch w=1.5u l=0.5u\nmp2 b a v v pch w=6u "
        "l=0.5u\nmn2 b a 0 0 "
        "nch w=1.5u l=0.5u\n";
    for (const double side : {0.0, 0.7}) {
        const auto outcome = run_text(latch + fmt::format(".nodeset v(a)={} v(b)={}\n.op\n", side, 0.7 - side));
        ASSERT_TRUE(outcome) << outcome.error().text();
        EXPECT_NEAR(found(*outcome, "v(a)"), side, 0.02);
        EXPECT_NEAR(found(*outcome, "v(b)"), 0.7 - side, 0.02);
    }
}

/// A random netlist that has an answer: a ladder of resistors and diodes, mirrors, chains of inverters, rings of two.
std::string drawn(unsigned seed) {
    std::mt19937 draw(seed);
    const auto up_to = [&](unsigned n) { return static_cast<unsigned>(draw() % n); };
    const auto log_between = [&](double a, double b) { return a * std::pow(b / a, static_cast<double>(draw()) / 4294967295.0); };
    std::string text = fmt::format("netlist {}\n.lib 'tsmc180.lib' tt\nvdd v 0 {:.3f}\n", seed, log_between(0.4, 1.8));
    const unsigned kind = up_to(4), length = 1 + up_to(12);
    if (kind == 0) {
        std::string node = "v";
        for (unsigned k = 0; k < length; ++k) {
            const auto next = fmt::format("n{}", k);
            text += fmt::format("r{} {} {} {:.3g}\n", k, node, next, log_between(1, 1e9));
            text += up_to(2) ? fmt::format("d{} {} 0 dx {:.2g}\n", k, next, log_between(0.1, 10))
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
            text += fmt::format("ma{0} g{0} g{0} {1} {1} {2} w=1.5u l=0.5u m={3} stack={4}\n", k, rail, model, 1 + up_to(8), 1 + up_to(8));
            text += fmt::format("mb{0} g{5} g{0} {1} {1} {2} w=1.5u l=0.5u m={3} stack={4}\n", k, rail, model, 1 + up_to(8), 1 + up_to(8),
                                k + 1);
        }
        text += fmt::format("ml g{0} g{0} {1} {1} {2} w=1.5u l=0.5u\n", length, length % 2 ? "v" : "0", length % 2 ? "pch" : "nch");
    }
    if (kind >= 2) {  // 3: the last drives the first
        if (kind == 2) text += fmt::format("vin n0 0 {:.3f}\n", log_between(0.01, 0.7));
        const unsigned count = kind == 3 ? length + length % 2 : length;  // an even ring latches
        for (unsigned k = 0; k < count; ++k) {
            const auto out = kind == 3 && k + 1 == count ? std::string("n0") : fmt::format("n{}", k + 1);
            text += fmt::format("mp{0} {1} n{0} v v pch w=6u l=0.5u stack={2}\nmn{0} {1} n{0} 0 0 nch w=1.5u l=0.5u m={3}\n", k, out,
                                1 + up_to(8), 1 + up_to(4));
        }
    }
    return text + ".op\n";
}

TEST(OperatingPoint, OfAThousandRandomNetlistsAllAreFoundAndHold) {
    int by_newton = 0;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        const auto text = drawn(seed);
        std::shared_ptr<const Circuit> circuit;
        const auto outcome = run_text(text, &circuit);
        ASSERT_TRUE(outcome) << outcome.error().text() << "\n" << text;
        by_newton += outcome->analyses[0].findings.table.find("found by newton") != std::string::npos;
        const auto system = System::make(circuit);
        ASSERT_TRUE(system);
        std::vector<double> x;
        for (const auto& c : outcome->analyses[0].findings.plots[0].curves) x.push_back(c.values[0].real());
        Sums sums;
        auto memory = system->fresh_memory();
        Instant at;
        at.gmin = 1e-15;
        do system->eval(x, at, memory, sums);
        while (sums.limited);
        for (std::size_t n = 0; n < x.size(); ++n)
            ASSERT_LE(std::abs(sums.f[n]), 1e-6 * sums.size[n] + 1e-16) << system->names()[n] << " of\n" << text;
    }
    EXPECT_GT(by_newton, 500);
}

TEST(Variants, DrawKIsTheSameWhateverElseIsDrawn) {
    const auto netlist = [](int count) {
        return Netlist::parse(
            fmt::format("t\ni1 0 a 1n\nm1 a a 0 0 n w=1u l=1u\n.model n nmos(level=80 avt=3e-9 svt0=10m)\n.mc {} seed=4\n.op\n", count),
            "t.cir", [](const std::string&) -> Result<std::string> { return bad_input("none"); });
    };
    const auto few = netlist(3), many = netlist(7);
    ASSERT_TRUE(few && many);
    const auto a = Variants::of(*few), b = Variants::of(*many);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->count(), 3U);
    std::vector<double> seen;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto one = a->at(k), other = b->at(k);
        ASSERT_TRUE(one && other);
        EXPECT_EQ(one->circuit->elements[1].values.at("delvto"), other->circuit->elements[1].values.at("delvto"));
        EXPECT_EQ(one->circuit->models[0].values.at("vto"), other->circuit->models[0].values.at("vto"));
        seen.push_back(one->circuit->elements[1].values.at("delvto"));
    }
    EXPECT_NE(seen[0], seen[1]);
}

TEST(Variants, ABillionStepsAreRefusedAtOnce) {
    const auto netlist = Netlist::parse("t\n.param r=1\nv1 a 0 1\nr1 a 0 {r}\n.step param r 1 1g 1\n.op\n", "t.cir",
                                        [](const std::string&) -> Result<std::string> { return bad_input("none"); });
    ASSERT_TRUE(netlist);
    const auto variants = Variants::of(*netlist);
    ASSERT_FALSE(variants);
    EXPECT_NE(variants.error().text().find("t.cir:5"), std::string::npos) << variants.error().text();
}

}  // namespace
}  // namespace corpuscle::circuit
