// Tables of targets: their errors, their measures, and fits to them.

#include <fmt/format.h>

#include "fit/afferent_fit.hpp"
#include "fit/targets/target_problem.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::value_or_throw;

AfferentPlan plan_of(const std::string& name, const std::vector<std::string>& settings = {}) {
    return test::applied_or_throw(plan_afferent(name, test::parse_settings(settings)));
}

std::vector<TargetRow> targets(const TemporaryFolder& folder, const std::string& rows) {
    return value_or_throw(read_targets(folder.write("targets.csv", "stimulus,settings,measure,value,low,high,set\n" + rows)));
}

/// The value of a measure of an afferent.
double measured(const TemporaryFolder& folder, const AfferentPlan& plan, const std::string& stimulus, const std::string& settings,
                const std::string& measure) {
    const auto rows = targets(folder, fmt::format("{},{},{},1,0.5,2,\n", stimulus, settings, measure));
    return value_or_throw(value_or_throw(make_target_problem(rows, {}))->rows(plan))[0].fitted;
}

TEST(Targets, ErrorsNameLineColumnAndRemedy) {
    const TemporaryFolder folder;
    const std::string header = "stimulus,settings,measure,value,low,high\n";
    const std::pair<std::string, const char*> rows[] = {
        {"", "t.csv: no targets in this file: it is empty"},
        {header, "t.csv: the table has no targets"},
        {"stimulus,mesure,value\n", "t.csv:1:10: unknown column 'mesure'; did you mean 'measure'?"},
        {"stimulus,value\n", "t.csv:1: the column 'measure' is missing"},
        {header + "press,,peek_rate,1,,\n", "t.csv:2:8: unknown measure 'peek_rate'; did you mean 'peak_rate'?"},
        {header + "press,,peak_rate,many,,\n", "t.csv:2:18: value: 'many'"},
        {header + "press,,peak_rate,3 V,,\n", "is a voltage"},
        {header + "press,,peak_rate,3,4,5\n", "t.csv:2:18: value 3 must lie between low 4 and high 5"},
        {header + "press,,spikes,0,,\n", "t.csv:2:15: a target of 0 needs the column high"},
        {header + "pres,,peak_rate,1,,\n", "did you mean 'press'?"},
        {header + "press,F_mx=2N,peak_rate,1,,\n", "t.csv:2:7: press: unknown parameter 'F_mx'; did you mean 'F_max'?"},
        {header + "press,F_max,peak_rate,1,,\n", "'F_max' is not a setting"},
        {header + "press,sine.f=2,peak_rate,1,,\n", "is for none of the stimuli of this row"},
        {header + "press,,peak_rate@up,1,,\n", "press has no phase 'up'; it has rest, protraction"},
        {header + "sine,,peak_rate@hold,1,,\n", "write a window, such as @0.4s..0.6s"},
        {header + "press,,peak_rate@2s..1s,1,,\n", "is not a window"},
        {header + "press,,vector_strength,1,,\n", "needs a periodic stimulus"},
        {header + "ramp-hold,,least_force,-1,-2,1\n", "must be above 0"},
        {header + "press,,spikes,-5,-6,1\n", "t.csv:2:15: value -5: spikes cannot be negative"},
        {header + "press,F_max=2N,t_up=1s,peak_rate,1,,\n", "t.csv:2: 7 columns where 6 are expected"},
        {"stimulus,measure,value,set\npress,peak_rate,1,tst\n", "t.csv:2:19: set 'tst': write train"},
        {"stimulus,measure,value,weight\npress,peak_rate,1,0\n", "t.csv:2:19: weight 0 must be above 0"}};
    for (const auto& [text, message] : rows) {
        const auto result = read_targets(folder.write("t.csv", text));
        ASSERT_FALSE(result) << message;
        EXPECT_NE(result.error().text().find(message), std::string::npos) << result.error().text() << "\nexpected: " << message;
    }
}

TEST(Targets, AWindowMustLieWithinTheStimulus) {
    const TemporaryFolder folder;
    for (const auto* window : {"0.9s..9s", "-1s..0.5s"}) {
        const auto problem = make_target_problem(targets(folder, fmt::format("press,,mean_rate@{},3,1,5,\n", window)), {});
        ASSERT_FALSE(problem) << window;
        EXPECT_NE(problem.error().text().find("targets.csv:2:8: the window"), std::string::npos) << problem.error().text();
        EXPECT_NE(problem.error().text().find("from 0 to 1 s"), std::string::npos) << problem.error().text();
    }
}

TEST(Targets, AForceThatIsReachedWithoutStrengthHasNoValue) {
    const TemporaryFolder folder;
    const auto problem = value_or_throw(make_target_problem(targets(folder, "press,,least_force,1,0.5,2,\n"), {}));
    const auto row = value_or_throw(problem->rows(plan_of("sa1-nerve")))[0];
    EXPECT_TRUE(std::isinf(row.fitted)) << row.fitted;
    EXPECT_NE(row.reason.find("press excites the afferent without it"), std::string::npos) << row.reason;
}

TEST(Targets, ThatAreAllHeldOutAreAnError) {
    const TemporaryFolder folder;
    EXPECT_FALSE(make_target_problem(targets(folder, "press,,spikes,3,1,5,test\n"), {}));
}

TEST(Targets, TheLeastForceIsWhereTheFirstSpikeAppears) {
    const TemporaryFolder folder;
    const auto plan = plan_of("sa1");
    const double least = measured(folder, plan, "ramp-hold", "t_hold=0.3s", "least_force");
    const auto spikes_at = [&](double factor) {
        return measured(folder, plan, "ramp-hold", fmt::format("t_hold=0.3s; F_max={:.17g}N", factor * least), "spikes");
    };
    EXPECT_EQ(spikes_at(0.99), 0);
    EXPECT_GE(spikes_at(1.01), 1);
}

TEST(Targets, ThePlateauOfEntrainmentBeginsAndEndsAtItsAmplitudes) {
    const TemporaryFolder folder;
    const auto plan = plan_of("fa1");
    const double least = measured(folder, plan, "sine", "f=30Hz", "least_amplitude"),
                 largest = measured(folder, plan, "sine", "f=30Hz", "largest_amplitude");
    EXPECT_LE(least, largest);
    EXPECT_DOUBLE_EQ(measured(folder, plan, "sine", "f=30Hz", "plateau_ratio"), largest / least);
    const auto rate_at = [&](double amplitude) {
        return measured(folder, plan, "sine", fmt::format("f=30Hz; F_amp={:.17g}N", amplitude), "mean_rate");
    };
    EXPECT_LT(rate_at(0.98 * least), 0.95 * 30);
    EXPECT_GE(rate_at(1.02 * least), 0.95 * 30);
    EXPECT_GE(rate_at(1.02 * largest), 1.05 * 30);
}

TEST(Targets, MeasuresOfPhasesAndWindowsAreThoseOfTheTrain) {
    const TemporaryFolder folder;
    const auto plan = plan_of("sa1");
    const auto train = test::train("sa1", "press");
    EXPECT_EQ(measured(folder, plan, "press", "", "spikes"), static_cast<double>(train.size()));
    EXPECT_DOUBLE_EQ(measured(folder, plan, "press", "", "peak_rate@protraction"), measure<PeakRate>(train, {0.25, 0.375}));
    EXPECT_DOUBLE_EQ(measured(folder, plan, "press", "", "mean_rate@0.4s..0.6s"), measure<MeanRate>(train, {0.4, 0.6}));
    double least = 1;
    for (std::size_t k = 0; k + 1 < train.size(); ++k) least = std::min(least, train[k + 1] - train[k]);
    EXPECT_DOUBLE_EQ(measured(folder, plan, "press", "", "min_interval"), least);
}

constexpr const char* row_format = "{},{},{},{:.6g},{:.6g},{:.6g},\n";

/// A table with the numbers of an afferent, each with a range of 2 %.
std::vector<TargetRow> numbers_of(const TemporaryFolder& folder, const AfferentPlan& plan,
                                  const std::vector<std::array<std::string, 3>>& what) {
    std::string rows;
    for (const auto& [stimulus, settings, measure] : what) {
        const double value = measured(folder, plan, stimulus, settings, measure);
        rows += fmt::format(fmt::runtime(row_format), stimulus, settings, measure, value, 0.98 * value, 1.02 * value);
    }
    return targets(folder, rows);
}

TEST(Targets, KnownParametersAreRecoveredFromRates) {
    const TemporaryFolder folder;
    const auto truth = plan_of("sa1", {"sa1.k_A=1.5u", "sa1.K_B=5u", "sa1.f_B=12Hz"});
    auto rows = numbers_of(folder, truth,
                           {{"ramp-hold", "F_max=2N", "peak_rate@protraction"},
                            {"ramp-hold", "F_max=2N; t_up=20ms", "peak_rate"},
                            {"ramp-hold", "F_max=4N; t_up=50ms", "peak_rate"},
                            {"ramp-hold", "F_max=3N; t_up=300ms", "mean_rate@protraction"},
                            {"ramp-hold", "F_max=2N", "mean_rate@plateau"},
                            {"ramp-hold", "t_hold=0.3s", "least_force"},
                            {"sine", "f=10Hz; F_amp=0.8N", "mean_rate@0.5s..1s"},
                            {"ramp-hold", "F_max=4N", "mean_rate@plateau"}});
    rows.back().is_test = true;
    const auto problem = value_or_throw(make_target_problem(rows, {}));
    const auto start = plan_of("sa1");
    const auto parameters = value_or_throw(free_parameters(start, std::vector<std::string>{"k_A", "K_B", "f_B"}, {}));
    ThreadPool pool(2);
    const auto result = value_or_throw(fit(*problem, start, parameters, pool, {.points = 100, .starts = 3, .evaluations = 150}));
    const double expected[] = {1.5e-6, 5e-6, 12};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& p = result.parameters[k];
        ASSERT_TRUE(p.low.has_value()) << p.parameter.name;
        EXPECT_LE(*p.low, expected[k]) << p.parameter.name;
        EXPECT_GE(*p.high, expected[k]) << p.parameter.name;
        EXPECT_NEAR(p.value / expected[k], 1, 0.1) << p.parameter.name;
    }
    for (const auto& row : result.rows) EXPECT_TRUE(*row.is_within()) << row.data << " " << row.measure << ": " << row.fitted;
    EXPECT_LT(*result.test_score, 1);
}

TEST(Targets, MoreParametersThanTargetsGiveAWarning) {
    const TemporaryFolder folder;
    const auto start = plan_of("sa1");
    const auto problem = value_or_throw(make_target_problem(targets(folder, "ramp-hold,,mean_rate@plateau,20,15,25,\n"), {.rate = 2e3}));
    const auto parameters = value_or_throw(free_parameters(start, std::vector<std::string>{"k_A", "K_C"}, {}));
    ThreadPool pool(2);
    const auto result = value_or_throw(fit(*problem, start, parameters, pool, {.points = 20, .starts = 2, .evaluations = 60}));
    ASSERT_FALSE(result.warnings.empty());
    EXPECT_NE(result.warnings.back().find("2 free parameters but only 1 data"), std::string::npos) << result.warnings.back();
    EXPECT_FALSE(result.parameters[0].low && result.parameters[1].low);
    EXPECT_FALSE(result.trades.empty());
}

}  // namespace
}  // namespace corpuscle
