// .assert: a quantity outside its design range is reported, in a netlist's transient and in the response of a netlist afferent.

#include "circuit/analysis/transient_setup.hpp"

#include <gtest/gtest.h>

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/netlist/parsed_netlist.hpp"
#include "circuit/netlist_runner.hpp"
#include "run/run_inputs.hpp"
#include "support/program.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

/// The force as a voltage, 1 V/N, with a design range of -1 to 1 V.
const std::string follower = "follower\nvf f 0 force 1\nrf f s 1k\ncs s 0 1n\n.spike v(s) 2 rise\n.assert v(f) -1 1 \"too much force\"\n";

TEST(OperatingRange, ATransientReportsDurationAndStart) {
    const auto ramp =
        run_netlist("t\nv1 a 0 pwl(0 0 1 1 2 0)\nr1 a 0 1k\n.assert v(a) -1 0.2505 \"too high\"\n.assert v(a) -1 2\n.tran 1m 2 0 1m\n");
    ASSERT_EQ(ramp.warnings().size(), 1U) << "only the first range is violated";
    const auto& sentence = ramp.warnings()[0].message;
    EXPECT_TRUE(sentence.starts_with("v(a) was outside -1 V to 250.5 mV for 1.499 s of 2 s, first at 251 ms")) << sentence;
    EXPECT_TRUE(sentence.ends_with(": too high")) << sentence;
    EXPECT_EQ(ramp.warnings()[0].location.line, 4);
}

TEST(OperatingRange, AnAfferentCountsTheSamplesOutsideInBlocksOfAnySize) {
    const auto design = test::value_or_throw(CircuitAfferentFactory::create(test::value_or_throw(parse_netlist_text(follower))));
    const auto afferent = design->make(1e-3, false);
    ASSERT_EQ(afferent->ranges().size(), 1U);
    std::vector<double> force(400, 0.5);
    for (std::size_t k = 100; k < 150; ++k) force[k] = 1.5;
    force.insert(force.end(), static_cast<std::size_t>(afferent->delay()), 0.5);
    for (const std::size_t block : {std::size_t{1}, std::size_t{33}, force.size()}) {
        std::vector<Spike> spikes;
        std::vector<RangeViolation> outside(1);
        ResponseBlock response{spikes};
        response.range_violations = outside;
        auto state = afferent->start();
        for (std::size_t k = 0; k < force.size(); k += block)
            ASSERT_TRUE(afferent->respond(std::span(force).subspan(k, std::min(block, force.size() - k)), state, response));
        EXPECT_EQ(outside[0].samples, 50) << block;
        EXPECT_EQ(outside[0].first_sample, 100) << block;
    }
}

TEST(OperatingRange, RespondWarnsOnce) {
    const test::TemporaryFolder folder;
    folder.write("f.cir", follower);
    const auto ran = test::run_program(folder, "respond press --afferent f.cir --quiet");
    EXPECT_EQ(ran.status, 0);
    EXPECT_NE(ran.err.find("warning: f.cir on press: v(f) was outside -1 V to 1 V for"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find(": too much force"), std::string::npos) << ran.err;
    EXPECT_EQ(test::run_program(folder, "respond press --afferent f.cir --quiet --set press.F_max=0.9N").err, "");
}

TEST(OperatingRange, ErrorsNameTheirLocation) {
    const auto refusal = [](const std::string& line) {
        const auto made = CircuitAfferentFactory::create(
            test::value_or_throw(parse_netlist_text("t\nvf f 0 force 1\nr1 f 0 1\n.spike v(f) 1\n" + line + "\n")));
        return made ? std::string() : made.error().message;
    };
    EXPECT_EQ(refusal(".assert v(f) 0 1"), "");
    EXPECT_NE(refusal(".assert v(g) 0 1").find("v(g)"), std::string::npos);
    EXPECT_EQ(refusal(".assert v(f) 1 0"), ".assert: 1 to 0: LOW must be below HIGH");
    EXPECT_EQ(refusal(".assert v(f) 1"), ".assert: the highest value is missing");
    EXPECT_NE(refusal(".assert v(f) 0 1 loud").find("'loud' must be a message in double quotes"), std::string::npos);
    EXPECT_NE(refusal(".assert v(f) 0 1 \"a\" \"b\"").find("unexpected '\"b\"'"), std::string::npos);
}

TEST(OperatingRange, FormerDirectivesAreRefusedWithTheirPresentNames) {
    for (const auto& [old_name, new_name] : renamed_directives) {
        const auto read = parse_netlist_text(fmt::format("t\nr1 f 0 1\n{} v(f) 0 1\n", old_name));
        ASSERT_FALSE(read) << old_name;
        EXPECT_EQ(read.error().message, fmt::format("{} is now {}", old_name, new_name));
        EXPECT_EQ(read.error().location.line, 3);
    }
}

}  // namespace
}  // namespace corpuscle::circuit
