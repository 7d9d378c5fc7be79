// Optimization files: what they mean, and errors that name file, line and remedy.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "optimize/problem.hpp"
#include "support/support.hpp"
#include "support/test_paths.hpp"

namespace corpuscle::optimize {
namespace {

using test::value_or_throw;

const std::string head = "afferent = \"sa1-circuit\"\n";
const std::string variable = "[[variable]]\nwhat = \"i_biasf\"\nfrom = \"100nA\"\nto = \"1uA\"\n";
const std::string goal = "[goal]\nminimize = \"power\"\n";

std::string error_of(const std::string& text) {
    const auto read = read_problem_text(text, "o.toml");
    return read ? "" : read.error().text();
}

TEST(OptimizationFile, HasConditionsThenChips) {
    const auto p = value_or_throw(read_problem_text(
        head + variable + goal + "[[at]]\nwhat = \"corner\"\nlist = [\"tt\", \"ss\"]\n[[at]]\nwhat = \"temp\"\nlist = [27, 85]\n" +
            "[chips]\nsamples = 3\ncorner = \"mc\"\nyield = \"90%\"\n[pattern]\nlike = \"sa1\"\ncases = \"nominal\"\nwithin = 1\n",
        "o.toml"));
    ASSERT_EQ(p.cases.size(), 7U);
    EXPECT_EQ(p.condition_count, 4U);
    EXPECT_EQ(p.cases[1].text, "corner=tt temp=85");
    EXPECT_EQ(p.cases[4].text, "chip 1");
    EXPECT_EQ(p.cases[4].values, (std::vector<double>{2, 27}));  // corner mc, the first temperature
    EXPECT_EQ(p.required_yield, 0.9);
    EXPECT_TRUE(p.has_pattern(0) && p.has_pattern(4));
    EXPECT_FALSE(p.has_pattern(1));
    EXPECT_EQ(p.variables[0].start, 700e-9);
    EXPECT_EQ(p.variables[0].unit, "A");  // from the source whose value the .param is
    std::vector<std::pair<double, double>> ranges;
    for (const auto& phase : p.pattern->phases) ranges.emplace_back(phase.min, phase.max);
    EXPECT_EQ(ranges, (std::vector<std::pair<double, double>>{{0, 0}, {4, 6}, {8, 10}, {0, 2}, {0, 1}}));
}

TEST(OptimizationFile, PositionsCoverTheRangeOfAVariable) {
    const DesignVariable linear{{"a"}, "", 2, 6, 3}, logarithmic{{"a"}, "", 1, 100, 10, true}, whole{{"a"}, "", 1, 8, 2, false, true};
    EXPECT_EQ(linear.value(0), 2);
    EXPECT_EQ(linear.value(0.25), 3);
    EXPECT_EQ(linear.value(1), 6);
    EXPECT_NEAR(logarithmic.value(0.5), 10, 1e-12);
    EXPECT_EQ(logarithmic.value(1), 100);
    EXPECT_NEAR(logarithmic.position(10), 0.5, 1e-12);
    EXPECT_EQ(whole.value(0.5), 5);  // 4.5 is rounded
}

TEST(OptimizationFile, ErrorsNameLineAndRemedy) {
    const std::map<std::string, std::string> expected = {
        {head + "[[variable]]\nwhat = \"i_biasf\"\nfrom = \"1uA\"\nto = \"100nA\"\n" + goal,
         "o.toml:4:8: i_biasf: the bounds cross: from = 1uA is above to = 100nA; exchange them"},
        {head + "[[variable]]\nwhat = \"i_biassf\"\nfrom = \"1uA\"\nto = \"2uA\"\n" + goal, "o.toml:3:8:"},
        {head + "[[variable]]\nwhat = \"i_biasf\"\nfrom = \"100mV\"\nto = \"1V\"\n" + goal,
         "o.toml:4:8: i_biasf: from = 100mV has the unit V, but i_biasf is in A"},
        {head + "[[variable]]\nwhat = \"summer.mn3b.w\"\nfrom = \"1uA\"\nto = \"2uA\"\n" + goal, "o.toml:4:8:"},
        {head + "[[variable]]\nwhat = \"i_biasf\"\nfrom = \"1nA\"\nto = \"2nA\"\n" + goal,
         "o.toml:3:8: i_biasf: its present value 700 nA is outside the bounds [1 nA, 2 nA]; widen them, or give a start between them"},
        {head + "[[variable]]\nwhat = \"i_biasf\"\nfrom = \"1nA\"\n" + goal, "o.toml:3:8: i_biasf: 'to' is missing"},
        {head + "[[variable]]\nwhat = \"summer.n3b\"\nfrom = \"2x4\"\nto = \"8x4\"\n" + goal,
         "o.toml:4:8: summer.n3b: the bounds must be numbers; for the columns of an array write what = \"summer.n3b.m\""},
        {head + "[[variable]]\nwhat = \"summer.n3b.m\"\nfrom = 1.5\nto = 20\n" + goal,
         "o.toml:4:8: summer.n3b.m: the bounds of an integer must be integers"},
        {head + goal, "o.toml: there is nothing to optimize; add a [[variable]]"},
        {head + variable, "o.toml: there is neither a goal nor a limit"},
        {head + variable + "[goal]\nminimize = \"pwoer\"\n", "o.toml:7:12: unknown measure 'pwoer'; did you mean 'power'?"},
        {head + variable + "[goal]\nminimize = \"yield\"\n", "o.toml:7:12: the yield is the fraction of the [chips] within"},
        {head + variable + "[goal]\nminimize = \"distance\"\n", "o.toml:7:12: the distance is that of the spikes from a [pattern]"},
        {head + variable + "[goal]\nminimize = \"power\"\nmaximize = \"power\"\n", "o.toml:8:12: [goal]: give either minimize or maximize"},
        {head + variable + goal + "over = \"last\"\n", "o.toml:8:8: [goal]: over = \"last\" is unknown"},
        {head + variable + goal + "[chips]\nyield = \"90%\"\n", "o.toml:8:1: [chips]: 'samples' is missing"},
        {head + variable + goal + "[chips]\nsamples = 3\nyield = \"120%\"\n", "o.toml:10:9: yield = 120% is outside (0, 100 %]"},
        {head + variable + goal + "[chips]\nsamples = 3\ncornr = \"mc\"\n", "o.toml:10:1: [chips]: 'cornr' is neither"},
        {head + variable + goal + "[chips]\nsamples = 0\n", "o.toml:9:11: samples = 0 must be an integer from 1 to 10000"},
        {head + variable + goal + "[pattern]\nfirst_spike = \"1ms\"\n", "o.toml:8:1: [pattern]: 'like' is missing"},
        {head + variable + goal + "[pattern]\nlike = \"sa9\"\n", "o.toml:9:8: like:"},
        {head + variable + goal + "[search]\nstarts = 0\n", "o.toml:9:10: starts = 0 must be an integer from 1 to 64"},
        {head + variable + goal + "[serch]\n", "o.toml:8:2:"},
        {head + variable + goal + "[[at]]\nlist = [1]\n", "o.toml:8:1: [[at]]: 'what' is missing"},
        {head + variable + goal + "[[at]]\nwhat = \"corner\"\nlist = [\"tt\", \"xx\"]\n", "o.toml:10:15:"},
        {head + variable + goal + "[limits]\nspikes = {at_least = 1}\n[nominal_limits]\nspikes = {at_most = 9}\n",
         "o.toml:11:1: [nominal_limits]: spikes has limits in [limits], too; keep one of them"},
        {head + variable + goal + "[nominal_limits]\nspiks = {at_most = 9}\n", "o.toml:9:1:"},
        {head + variable + variable + goal, "o.toml:7:8: 'i_biasf' varies twice"},
        {"afferent = \"nothing.cir\"\n" + variable + goal, "o.toml:1:12: there is no netlist 'nothing.cir'"},
    };
    for (const auto& [text, message] : expected) EXPECT_EQ(error_of(text).substr(0, message.size()), message) << text;
}

TEST(OptimizationFile, ANetlistWithItsOwnStepsIsRefused) {
    const test::TemporaryFolder folder;
    folder.write("own.cir", "own\n.param r=1k\nv1 a 0 1\nr1 a 0 {r}\n.op\n.step param r 1k 2k 1k\n.end\n");
    const auto read = read_problem_text(
        "netlist = \"own.cir\"\n[[variable]]\nwhat = \"r\"\nfrom = 1000\nto = 2000\n[goal]\nminimize = \"i(v1)\"\n", folder / "o.toml");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().text().find("own.cir:6:1: .step is not used here; remove it"), std::string::npos) << read.error().text();
}

TEST(OptimizationFile, TheExamplesAreRead) {
    std::size_t examples = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_root() + "/examples/optimize")) {
        if (entry.path().extension() != ".toml") continue;
        ++examples;
        const auto read = read_problem(entry.path().string());
        ASSERT_TRUE(read) << read.error().text();
        EXPECT_EQ(read->chip_count(), 20U) << entry.path();
    }
    EXPECT_EQ(examples, 3U);
}

TEST(OptimizationFile, AModelHasVariablesToo) {
    const auto p =
        value_or_throw(read_problem_text("afferent = \"sa1\"\n[[variable]]\nwhat = \"f_B\"\nfrom = \"5Hz\"\nto = \"40Hz\"\nstart = "
                                         "\"20Hz\"\n[goal]\nmaximize = \"spikes\"\n",
                                         "o.toml"));
    EXPECT_EQ(p.variables[0].start, 20);
    EXPECT_EQ(p.variables[0].unit, "Hz");
}

}  // namespace
}  // namespace corpuscle::optimize
