// Optimizations whose optimum is known in closed form, independence of threads, and resumption.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "optimize/design_evaluator.hpp"
#include "optimize/design_search.hpp"
#include "optimize/found_netlist.hpp"
#include "optimize/optimization_report.hpp"
#include "run/afferent_plan.hpp"
#include "support/support.hpp"

namespace corpuscle::optimize {
namespace {

using test::TemporaryFolder;
using test::value_or_throw;

/// v(out) is 100k / (100k + r), and the source delivers 1 V^2 / (r + 100k).
constexpr const char* loaded_divider = "divider\n.param r=10k tc=0\nvin in 0 1\nr1 in out {r} tc1={tc}\nrl out 0 100k\n.op\n.end\n";
constexpr const char* divider_problem =
    "netlist = \"divider.cir\"\n[[variable]]\nwhat = \"r\"\nfrom = \"1kohm\"\nto = \"1Mohm\"\nlog = true\n"
    "[goal]\nmaximize = \"i(vin)\"\n[limits]\n\"v(out)\" = {at_least = \"0.8V\"}\n[search]\npoints = 8\nstarts = 2\n";

struct Files {
    TemporaryFolder folder;
    Files() { folder.write("divider.cir", loaded_divider); }
    OptimizationProblem problem(const std::string& text) const { return value_or_throw(read_problem_text(text, folder / "problem.toml")); }
    OptimizationResult found(const std::string& text) const {
        auto p = problem(text);
        return value_or_throw(optimize_design(p, nullptr, {.threads = 2}));
    }
};

TEST(Optimize, FindsTheLargestResistanceThatKeepsTheOutput) {
    const Files files;
    const auto result = files.found(divider_problem);
    EXPECT_TRUE(result.is_settled);
    EXPECT_TRUE(result.found.score.is_within);
    EXPECT_NEAR(result.found.values[0], 25e3, 50);  // 100k / (100k + r) = 0.8
    EXPECT_LE(result.found.values[0], 25e3 * (1 + 1e-9));
    EXPECT_NEAR(result.found.score.goal, -8e-6, 2e-8);
    EXPECT_NEAR(result.start.score.goal, -1 / 110e3, 1e-12);
}

TEST(Optimize, ReportsTheActiveLimitAndTheSensitivity) {
    const Files files;
    auto problem = files.problem(divider_problem);
    const auto result = value_or_throw(optimize_design(problem, nullptr, {}));
    EXPECT_NEAR(result.limits[0].sensitivity, -0.2, 0.01);  // d ln i / d ln r = -r / (r + 100k)
    EXPECT_FALSE(result.limits[0].is_at_min || result.limits[0].is_at_max);
    ASSERT_TRUE(result.limits[0].up.has_value());
    EXPECT_FALSE(result.limits[0].up->is_within);
    const auto reasons = limiting_reasons(problem, result);
    ASSERT_EQ(reasons.size(), 1U);
    EXPECT_NE(reasons[0].find("v(out) at least 800 mV"), std::string::npos) << reasons[0];
}

TEST(Optimize, ReportsAnActiveBound) {
    const Files files;
    auto text = std::string(divider_problem);
    text.replace(text.find("1Mohm"), 5, "20kohm");
    auto problem = files.problem(text);
    const auto result = value_or_throw(optimize_design(problem, nullptr, {}));
    EXPECT_EQ(result.found.values[0], 20e3);
    EXPECT_TRUE(result.limits[0].is_at_max);
    const auto reasons = limiting_reasons(problem, result);
    ASSERT_EQ(reasons.size(), 1U);
    EXPECT_EQ(reasons[0], "r is at its upper bound, 20 kohm");
}

// The resistance rises by 1 % a kelvin, so the hottest of the temperatures decides, which the search first has to find.
TEST(Optimize, TheWorstConditionDecidesThoughTheSearchBeginsWithoutIt) {
    const Files files;
    const auto result = files.found(std::string(divider_problem) +
                                    "cases = 1\n[set]\ntc = 0.01\n[[at]]\nwhat = \"temp\"\nlist = [27, -20, 0, 60, 77, 50]\n");
    EXPECT_NEAR(result.found.values[0], 25e3 / 1.5, 50);
    EXPECT_GT(result.rounds, 1U);
    EXPECT_LT(result.active_cases, 6U);
}

// One of the shifted designs has r larger by 0.57 of 0.2 % of its range (three decades), which the limit must allow.
TEST(Optimize, ADesignThatSmallChangesTakeOutOfTheLimitsIsNotFound) {
    const Files files;
    auto text = std::string(divider_problem);
    text.insert(text.find("[[variable]]"), "[[variable]]\nwhat = \"tc\"\nfrom = 0\nto = 0.001\n");
    const auto result = files.found(text);
    EXPECT_TRUE(result.found.score.is_within);
    EXPECT_LT(result.found.values[1], 25e3 * std::pow(1000, -0.57 * 2e-3) * (1 + 1e-3));
    EXPECT_GT(result.found.values[1], 24e3);
}

TEST(Optimize, NominalLimitsHoldOnlyAtTheFirstCondition) {
    const Files files;
    auto text = std::string(divider_problem);
    text.replace(text.find("[limits]"), 8, "[nominal_limits]");
    const auto result = files.found(text + "[set]\ntc = 0.01\n[[at]]\nwhat = \"temp\"\nlist = [27, 77]\n");
    EXPECT_NEAR(result.found.values[0], 25e3, 50);
    EXPECT_TRUE(result.found.cases[1].is_within);
}

TEST(Optimize, AWholeNumberOfDevicesStaysWhole) {
    const Files files;
    files.folder.write("loads.cir", "loads\nvin in 0 1\nr1 in out 10k\nrl out 0 100k m=2\n.op\n.end\n");
    const auto result = files.found(
        "netlist = \"loads.cir\"\n[[variable]]\nwhat = \"rl.m\"\nfrom = 1\nto = 40\n"
        "[goal]\nminimize = \"v(out)\"\n[limits]\n\"v(out)\" = {at_least = \"0.47V\"}\n[search]\npoints = 0\nstarts = 1\n");
    EXPECT_EQ(result.found.values[0], 11);  // v(out) = 1 / (1 + m / 10): 0.476 V for 11, 0.4545 V for 12
}

TEST(Optimize, GoalsThatCannotBeMetAreReportedWithTheLimitThatFails) {
    const Files files;
    auto text = std::string(divider_problem);
    text.replace(text.find("0.8V"), 4, "0.999V");
    const auto result = files.found(text);
    EXPECT_FALSE(result.found.score.is_within);
    EXPECT_EQ(result.found.values[0], 1e3);  // the nearest to the limit
    EXPECT_EQ(result.found.score.limit, "v(out) at least 999 mV");
}

// ---- scores ----

CaseScore case_of(double excess) { return {excess <= 0, excess, "limit", 1}; }

TEST(DesignScores, TheChipThatDecidesIsTheWorstOneThatMayNotFail) {
    const Files files;
    auto problem = files.problem(divider_problem);
    problem.required_yield = 0.9;
    std::vector<std::size_t> cases = {0};
    std::vector<CaseScore> scores = {case_of(-1)};
    for (std::size_t chip = 0; chip < 20; ++chip) {
        problem.cases.push_back({{}, chip, ""});
        cases.push_back(chip + 1), scores.push_back(case_of(-0.5 - 0.01 * static_cast<double>(chip)));
    }
    scores[3] = case_of(2), scores[5] = case_of(3);  // two of twenty may fail
    auto score = score_design(problem, cases, scores);
    EXPECT_TRUE(score.is_within);
    EXPECT_EQ(score.chips_within, 18U);
    EXPECT_EQ(score.excess, -0.5);
    scores[7] = case_of(1);
    score = score_design(problem, cases, scores);
    EXPECT_FALSE(score.is_within);
    EXPECT_EQ(score.excess, 1);
    EXPECT_EQ(score.worst_case, 7U);
    // If only some chips were simulated, the others count as within the limits.
    const std::vector<std::size_t> few = {0, 3, 5};
    EXPECT_TRUE(score_design(problem, few, std::vector{scores[0], scores[3], scores[5]}).is_within);
}

TEST(DesignScores, ADesignOutsideTheLimitsIsWorseThanOneWithTheSameGoalWithinThem) {
    const Files files;
    const auto problem = files.problem(divider_problem);
    const DesignScore within{true, -1e-6, 0, 0, "", 0, 0};
    auto outside = within;
    outside.is_within = false, outside.excess = min_excess;
    EXPECT_LT(merit(problem, within, 1e-6), merit(problem, outside, 1e-6));
    auto further = outside;
    further.excess = 1;
    EXPECT_LT(merit(problem, outside, 1e-6), merit(problem, further, 1e-6));
}

// ---- chips ----

/// Small searches over the ideal blocks of SA-I, which are quick to simulate.
constexpr const char* macro_problem =
    "afferent = \"sa1-macro\"\nseed = 3\n[[variable]]\nwhat = \"c_u\"\nfrom = \"2pF\"\nto = \"12pF\"\nlog = true\n"
    "[[variable]]\nwhat = \"i_leak\"\nfrom = \"2pA\"\nto = \"10pA\"\n[[at]]\nwhat = \"temp\"\nlist = [27, 85]\n"
    "[pattern]\nlike = \"sa1\"\n[goal]\nminimize = \"distance\"\n[search]\npoints = 6\nstarts = 2\nevaluations = 10\nrounds = 2\n";

/// All outcomes of a results file, as text.
std::string rows_of(const SweepResults& results) {
    std::string out;
    value_or_throw(results.for_each_row([&](const std::vector<double>& axes, const ItemOutcome& o) {
        out += fmt::format("{} {} {} {}\n", o.item, fmt::join(axes, " "), o.iterations, fmt::join(o.measures, " "));
        return true;
    })
                       ? Result<int>(0)
                       : Result<int>(bad_input("rows")));
    return out;
}

struct MacroRun {
    std::string rows, document;
    std::size_t reused = 0;
};

MacroRun run_macro(const TemporaryFolder& folder, const std::string& name, unsigned threads, std::size_t lanes, double stop_at = 2) {
    auto problem = value_or_throw(read_problem_text(macro_problem, folder / "macro.toml"));
    problem.sweep->set_lanes(lanes);
    double progress = 0;  // fraction
    problem.sweep->item_count = DesignEvaluator::item_count(problem);
    auto results = value_or_throw(SweepResults::open(folder / name, *problem.sweep));
    const auto result = optimize_design(problem, &results,
                                        {.threads = threads,
                                         .should_stop = [&] { return progress > stop_at; },
                                         .on_progress = [&](double fraction) { progress = fraction; }});
    if (!result) {
        EXPECT_EQ(result.error().code, ErrorCode::interrupted) << result.error().text();
        return {rows_of(results), "", 0};
    }
    return {rows_of(results), document_of(problem, *result).dump(), result->reused};
}

TEST(Optimize, ThreadsAndLanesDoNotChangeTheResult) {
    const TemporaryFolder folder;
    const auto one = run_macro(folder, "one.sqlite", 1, 1), many = run_macro(folder, "many.sqlite", 3, 8);
    EXPECT_FALSE(one.document.empty());
    EXPECT_EQ(one.document, many.document);
    EXPECT_TRUE(one.rows == many.rows);
}

TEST(Optimize, AnInterruptedSearchResumesToTheSameResult) {
    const TemporaryFolder folder;
    const auto stopped = run_macro(folder, "stopped.sqlite", 2, 8, 0.1);
    EXPECT_TRUE(stopped.document.empty());
    EXPECT_FALSE(stopped.rows.empty());
    const auto resumed = run_macro(folder, "stopped.sqlite", 1, 4), complete = run_macro(folder, "complete.sqlite", 2, 8);
    EXPECT_GT(resumed.reused, 0U);
    EXPECT_EQ(resumed.document, complete.document);
    EXPECT_TRUE(resumed.rows == complete.rows);
    const auto again = run_macro(folder, "complete.sqlite", 2, 8);
    EXPECT_EQ(again.document, complete.document);
    EXPECT_EQ(again.reused, static_cast<std::size_t>(std::ranges::count(complete.rows, '\n')));
}

// ---- the found netlist ----

TEST(FoundNetlist, HasTheValuesOfTheDesignAndOtherwiseThoseOfTheNetlist) {
    const TemporaryFolder folder;
    const auto problem = value_or_throw(read_problem_text(
        "afferent = \"sa1-circuit\"\n[set]\nhv_membrane = 0\n[[variable]]\nwhat = \"i_biasf\"\nfrom = \"100nA\"\nto = \"1uA\"\n"
        "[[variable]]\nwhat = [\"rectb.mp1a.m\", \"rectb.mp1b.m\"]\nfrom = 1\nto = 8\n[[at]]\nwhat = \"corner\"\nlist = [\"ss\", \"ff\"]\n"
        "[goal]\nminimize = \"power\"\n",
        folder / "p.toml"));
    const std::vector<double> design = {300e-9, 5};
    const std::vector<std::string> comment = {"a comment"};
    const auto text = value_or_throw(found_netlist(problem, design, folder.path(), comment));
    EXPECT_TRUE(is_found_netlist(text));
    EXPECT_FALSE(is_found_netlist("title\n* Another netlist\n"));
    folder.write("found.cir", text);
    const auto found = value_or_throw(value_or_throw(circuit::Netlist::read(folder / "found.cir")).elaborate());
    const auto expected =
        value_or_throw(value_or_throw(problem.sweep->netlist().at(problem.axis_values(design, problem.cases[0]))).elaborate());
    EXPECT_EQ(found.parameters, expected.parameters);
    ASSERT_TRUE(sweeps::same_devices(found, expected));
    for (std::size_t k = 0; k < found.elements.size(); ++k) {
        EXPECT_EQ(found.elements[k].values, expected.elements[k].values) << found.elements[k].name;
        EXPECT_EQ(found.elements[k].value, expected.elements[k].value) << found.elements[k].name;
        EXPECT_EQ(found.elements[k].waveform.dc, expected.elements[k].waveform.dc) << found.elements[k].name;
    }
    for (std::size_t k = 0; k < found.models.size(); ++k) EXPECT_EQ(found.models[k].values, expected.models[k].values);
    EXPECT_EQ(found.parameters.at("i_biasf"), 300e-9);
    EXPECT_EQ(found.elements[static_cast<std::size_t>(found.find_element("xrectb.mp1b"))].values.at("m"), 5);
    EXPECT_FALSE(found.has_directive("expect"));
    EXPECT_TRUE(names_netlist(folder / "found.cir"));
}

TEST(FoundNetlist, CopiesTheFilesThatAUsersNetlistIncludes) {
    const TemporaryFolder folder;
    folder.write("part.inc", "* the load\nrl out 0 100k\n");
    folder.write("own.cir", "own\n.param r=10k\nvin in 0 1\nr1 in out {r}\n.include 'part.inc'\n.op\n.expect v(out) 0.909 1m\n.end\n");
    const auto problem =
        value_or_throw(read_problem_text("netlist = \"own.cir\"\n[[variable]]\nwhat = \"r\"\nfrom = 1000\nto = 100000\n"
                                         "[goal]\nminimize = \"v(out)\"\n",
                                         folder / "p.toml"));
    const auto text = value_or_throw(found_netlist(problem, std::vector{25e3}, "/elsewhere", {}));
    EXPECT_EQ(text.find(".include"), std::string::npos);
    EXPECT_EQ(text.find(".expect"), std::string::npos);
    const auto circuit = value_or_throw(value_or_throw(circuit::Netlist::parse_text(text, "found.cir")).elaborate());
    EXPECT_EQ(circuit.elements[static_cast<std::size_t>(circuit.find_element("r1"))].value, 25e3);
    EXPECT_EQ(circuit.elements[static_cast<std::size_t>(circuit.find_element("rl"))].value, 100e3);
}

}  // namespace
}  // namespace corpuscle::optimize
