// Fits to spikes: known parameters are found again, and what spikes do not determine is reported.

#include "fit/afferent_fit.hpp"

#include <atomic>
#include <nlohmann/json.hpp>

#include "fit/fit_document.hpp"
#include "fit/gauss_newton.hpp"
#include "fit/spike_problem.hpp"
#include "run/simulate.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

AfferentPlan plan_of(const std::vector<std::string>& settings) {
    return test::applied_or_throw(plan_afferent("sa1", test::parse_settings(settings)));
}

const std::vector<std::string> true_settings = {"sa1.k_A=1.5u", "sa1.K_B=5u", "sa1.f_B=12Hz"};

/// The response of an afferent with these settings to a vibration of rising frequency around a mean force, as a recording. Unlike a ramp,
/// it determines the gain and the cutoff frequency of a high-pass apart.
SpikeRecording recording(const std::vector<std::string>& settings, double noise = 0, std::uint64_t seed = 0,
                         const std::string& F_mean = "2N") {
    SpikeRecording out;
    out.name = "chirp", out.clock = value_or_throw(make_clock(2e3));
    out.force = test::force(
        "chirp", {.settings = {"chirp.F_mean=" + F_mean, "chirp.F_amp=1N", "chirp.f_to=40Hz", "chirp.duration=2s"}, .rate = 2e3});
    const SimulationOptions options{.dt = out.clock.T(), .noise = noise, .seed = seed};
    const auto response = value_or_throw(simulate(*make_afferent(plan_of(settings), options), out.force));
    out.trains = {{"sa1", spike_times(response.spikes, out.clock)}};
    return out;
}

FitResult fit_to(std::vector<SpikeRecording> recordings, const AfferentPlan& start, const std::vector<std::string>& free,
                 unsigned threads = 2, const std::vector<std::string>& bounds = {}) {
    const auto problem = value_or_throw(make_spike_problem(std::move(recordings), {}));
    ThreadPool pool(threads);
    const auto parameters = value_or_throw(free_parameters(start, free, bounds));
    return value_or_throw(fit(*problem, start, parameters, pool, {.points = 100, .starts = 4, .evaluations = 200}));
}

TEST(Fit, RecoversKnownParametersFromSpikesWithoutNoise) {
    const auto result = fit_to({recording(true_settings)}, plan_of({}), {"k_A", "K_B", "f_B"});
    const double expected[] = {1.5e-6, 5e-6, 12};
    ASSERT_EQ(result.parameters.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& p = result.parameters[k];
        EXPECT_NEAR(p.value / expected[k], 1, 1e-3) << p.parameter.name;
        EXPECT_TRUE(p.low.has_value()) << p.parameter.name;
    }
    EXPECT_LT(result.score, 1e-4);
    EXPECT_GT(result.start_score, 0.05);
    EXPECT_TRUE(result.trades.empty());
}

// 12 seeds with 3 parameters each. If each interval contained the true value with a probability of 95 %, fewer than 29 of 36 would have a
// probability of 1e-4.
TEST(Fit, IntervalsContainTheKnownParametersOfNoisySpikes) {
    const double expected[] = {1.5e-6, 5e-6, 12};
    int inside = 0, identified = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const auto result = fit_to({recording(true_settings, 30e-9, seed)}, plan_of({}), {"k_A", "K_B", "f_B"});
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& p = result.parameters[k];
            EXPECT_NEAR(p.value / expected[k], 1, 0.25) << p.parameter.name << ", seed " << seed;
            if (!p.low) continue;
            ++identified, inside += *p.low <= expected[k] && expected[k] <= *p.high;
            EXPECT_LT(*p.high / *p.low, 4) << p.parameter.name;
        }
    }
    EXPECT_GE(identified, 30);
    EXPECT_GE(inside * 36, 29 * identified);
}

TEST(Fit, DoesNotDependOnTheNumberOfThreads) {
    const auto document = [](unsigned threads) {
        return document_of(fit_to({recording(true_settings, 30e-9, 1)}, plan_of({}), {"k_A", "f_B"}, threads), "").dump();
    };
    const auto alone = document(1);
    EXPECT_EQ(alone, document(2));
    EXPECT_EQ(alone, document(5));
}

TEST(Fit, ReportsParametersThatScaleTogether) {
    // Without leak, the rate is k_A F / (C_m V_th): only the ratio of k_A and V_th matters.
    const std::vector<std::string> integrator = {"sa1.K_B=0", "sa1.K_C=0", "sa1.I_leak0=0", "sa1.V_reset=0"};
    const auto result = fit_to({recording(integrator)}, plan_of(integrator), {"k_A", "V_th"});
    for (const auto& p : result.parameters) EXPECT_FALSE(p.low.has_value()) << p.parameter.name;
    EXPECT_NEAR(result.parameters[0].value / result.parameters[1].value, 1e-6 / 0.5, 1e-10);
    ASSERT_EQ(result.trades.size(), 1U);
    ASSERT_EQ(result.trades[0].factors.size(), 2U);
    EXPECT_EQ(result.trades[0].factors[0].first, "k_A");
    EXPECT_EQ(result.trades[0].factors[1].first, "V_th");
    EXPECT_NEAR(result.trades[0].factors[0].second / result.trades[0].factors[1].second, 1, 1e-6);
    EXPECT_LT(std::abs(result.trades[0].score_change), 1e-6);
}

TEST(Fit, ReportsAParameterWithoutInfluence) {
    // The gain of the fast part is 0, so its cutoff frequency has no influence.
    const std::vector<std::string> without = {"sa1.K_B=0"};
    const auto result = fit_to({recording(without)}, plan_of(without), {"k_A", "f_B"});
    EXPECT_TRUE(result.parameters[0].low.has_value());
    EXPECT_FALSE(result.parameters[1].low.has_value());
    ASSERT_EQ(result.trades.size(), 1U);
    ASSERT_EQ(result.trades[0].factors.size(), 1U);
    EXPECT_EQ(result.trades[0].factors[0].first, "f_B");
}

TEST(Fit, ScoresHeldOutRecordings) {
    std::vector<SpikeRecording> recordings;
    for (const auto* force : {"1N", "1.5N", "2N", "3N"}) recordings.push_back(recording(true_settings, 20e-9, recordings.size(), force));
    hold_out(recordings, 0.25);
    const auto result = fit_to(recordings, plan_of({}), {"k_A", "K_B", "f_B"});
    ASSERT_TRUE(result.test_score.has_value());
    EXPECT_LT(*result.test_score, 0.05);
    EXPECT_GT(*result.test_score, 0);
    int held_out = 0;
    for (const auto& row : result.rows) held_out += row.is_test;
    EXPECT_EQ(held_out, 2);  // spikes, and matching spikes
}

TEST(Fit, WarnsOfAValueAtItsBound) {
    const auto result = fit_to({recording(true_settings)}, plan_of(true_settings), {}, 2, {"k_A=1.51u:1.6u"});
    EXPECT_TRUE(result.parameters[0].is_at_bound);
    EXPECT_FALSE(result.parameters[0].low.has_value());
    ASSERT_FALSE(result.warnings.empty());
    // The bounds that the warning prints have room below.
    const std::string option = "--bounds ";
    const auto at = result.warnings[0].find(option);
    ASSERT_NE(at, std::string::npos) << result.warnings[0];
    const auto wider = fit_to({recording(true_settings)}, plan_of(true_settings), {}, 2, {result.warnings[0].substr(at + option.size())});
    EXPECT_FALSE(wider.parameters[0].is_at_bound);
    EXPECT_NEAR(wider.parameters[0].value / 1.5e-6, 1, 1e-3);
}

TEST(Fit, AtAKinkOfTheCostTheIntervalIsNotNarrow) {
    // The residuals jump where a spike appears. At such a point the slopes must be those around it.
    const auto residuals = [](std::span<const double> x) -> Result<std::vector<ResidualBlock>> {
        return std::vector<ResidualBlock>{{{20 * x[0], x[0] < 0.5 ? 0.0 : 1.0, 3.0}}};
    };
    const FreeParameter linear{0, "a", "", 0, 0, 1, 0, 1};
    const auto at = value_or_throw(linearize(residuals, std::vector{linear}, std::vector{0.5}, 0.1));
    EXPECT_NEAR(std::sqrt(at.JJ[0]), 20, 5);
}

TEST(Fit, TheIntervalOfAPoorFitIsNotAPoint) {
    // With the gain of the fast part wrong, the best point lies where a spike appears.
    const auto result = fit_to({recording(true_settings)}, plan_of({}), {"k_A"});
    const auto& p = result.parameters[0];
    EXPECT_GT(result.score, 0.01);
    ASSERT_TRUE(p.low.has_value());
    EXPECT_GT(*p.high / *p.low, 1.005);
}

TEST(Fit, WarnsOfSpikesThatAreNotUsed) {
    auto recorded = recording(true_settings);
    recorded.spike_file = "nerve.csv";
    recorded.trains[0].times.push_back(7);
    const auto warnings = recording_warnings(std::vector{recorded}, plan_of({}));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("nerve.csv: 1 of "), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find("lie outside the time of chirp, 0 s to 2 s"), std::string::npos) << warnings[0];
    recorded.trains[0].times = {0.5, 0.7};
    EXPECT_NE(recording_warnings(std::vector{recorded}, plan_of({})).at(0).find("only 2 spikes"), std::string::npos);
}

TEST(Fit, WarnsOfSamplesThatAreTooFarApart) {
    auto recorded = recording(true_settings);
    recorded.clock = value_or_throw(make_clock(500));
    const auto plan = test::applied_or_throw(plan_afferent("fa2", {}));
    const auto warnings = recording_warnings(std::vector{recorded}, plan);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("the sample rate is 500 Hz, but this afferent needs 1000 Hz"), std::string::npos) << warnings[0];
}

TEST(FreeParameters, WiderBoundsEndAtTheRange) {
    const FreeParameter logarithmic{0, "a", "", 1, 0.5, 2, 0.1, 2}, linear{0, "b", "", 0, -1, 1, -2, 10};
    EXPECT_EQ(logarithmic.wider_bounds(false), "0.1:2");
    EXPECT_EQ(logarithmic.wider_bounds(true), "");
    EXPECT_EQ(linear.wider_bounds(false), "-2:1");
    EXPECT_EQ(linear.wider_bounds(true), "-1:3");
}

TEST(Fit, AnInterruptedSearchReturnsTheBestPointSoFar) {
    const auto problem = value_or_throw(make_spike_problem({recording(true_settings)}, {}));
    const auto start = plan_of({});
    const auto parameters = value_or_throw(free_parameters(start, std::vector<std::string>{"k_A", "K_B"}, {}));
    ThreadPool pool(2);
    int calls = 0;
    SearchOptions options{.points = 50, .starts = 2, .evaluations = 100};
    options.should_continue = [&](double fraction) {
        EXPECT_LE(fraction, 1);
        return ++calls < 120;
    };
    const auto result = value_or_throw(fit(*problem, start, parameters, pool, options));
    EXPECT_TRUE(result.is_interrupted);
    EXPECT_LE(result.score, result.start_score);
    EXPECT_FALSE(result.parameters[0].low.has_value());
}

TEST(Fit, AnInterruptedSearchEvaluatesNoMoreOfItsStarts) {
    std::atomic<int> evaluations = 0;
    const CostFunction cost = [&](std::span<const double> x, std::size_t) { return ++evaluations, (x[0] - 0.3) * (x[0] - 0.3); };
    ThreadPool pool(2);
    SearchOptions options{.points = 1000, .starts = 900, .evaluations = 100};
    int calls = 0;
    options.should_continue = [&](double) { return ++calls < 500; };
    const auto found = search_minimum(cost, std::vector<double>{0.9}, pool, options);
    EXPECT_TRUE(found.is_interrupted);
    EXPECT_LT(found.cost, 1e-4);  // that of the best of 500 random points
    EXPECT_LT(evaluations, 520);
}

TEST(Fit, EigenvaluesOfASymmetricMatrix) {
    const auto all = symmetric_eigensystem({2, 1, 0, 1, 2, 0, 0, 0, 5}, 3);
    EXPECT_NEAR(all.values[0], 1, 1e-14);
    EXPECT_NEAR(all.values[1], 3, 1e-14);
    EXPECT_NEAR(all.values[2], 5, 1e-14);
    EXPECT_NEAR(all.vectors[0][0], -all.vectors[0][1], 1e-14);
}

TEST(FreeParameters, HaveBoundsWithinTheirRange) {
    const auto plan = plan_of({});
    const auto of = [&](const std::vector<std::string>& names, const std::vector<std::string>& bounds) {
        return free_parameters(plan, names, bounds);
    };
    const auto all = value_or_throw(of({"sa1.k_A", "f_B"}, {"f_B=5Hz:0.05kHz"}));
    ASSERT_EQ(all.size(), 2U);
    EXPECT_DOUBLE_EQ(all[0].low, 1e-6 / 20);
    EXPECT_DOUBLE_EQ(all[0].high, 20e-6);
    EXPECT_DOUBLE_EQ(all[1].low, 5);
    EXPECT_DOUBLE_EQ(all[1].high, 50);
    EXPECT_NEAR(all[1].value(0.5), std::sqrt(5.0 * 50), 1e-12);
    EXPECT_NEAR(all[1].coordinate(all[1].value(0.3)), 0.3, 1e-12);
    const std::pair<std::vector<std::string>, const char*> refused[] = {
        {{"f_B"}, "f_B: write NAME=LOW:HIGH"},   {{"f_B=5"}, "write NAME=LOW:HIGH"},     {{"f_B=5Hz:2Hz"}, "the first must be below"},
        {{"f_B=5V:6V"}, "is a voltage"},         {{"t_ref=0:20s"}, "outside the range"}, {{"f_B=1:2", "f_B=1:2"}, "has bounds already"},
        {{"f_X=1:2"}, "unknown parameter 'f_X'"}};
    for (const auto& [bounds, message] : refused) {
        const auto result = of({}, bounds);
        ASSERT_FALSE(result) << message;
        EXPECT_NE(result.error().message.find(message), std::string::npos) << result.error().message;
    }
    EXPECT_NE(of({"t_ref"}, {}).error().message.find("--bounds t_ref=0.2ms:5ms"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
