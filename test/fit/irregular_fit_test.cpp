// Fits to the spikes of irregular afferents.

#include <fmt/format.h>

#include "fit/afferent_fit.hpp"
#include "fit/spike_problem.hpp"
#include "fit/targets/target_problem.hpp"
#include "run/simulate.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

AfferentPlan nerve_plan(const std::vector<std::string>& settings) {
    return test::applied_or_throw(plan_afferent("sa1-nerve", test::parse_settings(settings)));
}

/// The response of an irregular afferent with this seed to three presses.
SpikeRecording presses(const std::vector<std::string>& settings, std::uint64_t seed) {
    SpikeRecording out;
    out.name = "presses", out.clock = value_or_throw(make_clock(500));
    for (const std::string F_max : {"0.2N", "0.6N", "1.5N"}) {
        const auto press = test::force("press", {.settings = {"press.F_max=" + F_max}, .rate = 500});
        out.force.insert(out.force.end(), press.begin(), press.end());
    }
    const SimulationOptions options{.dt = out.clock.T(), .seed = seed};
    const auto response = value_or_throw(simulate(*make_afferent(nerve_plan(settings), options), out.force));
    out.trains = {{"sa1-nerve", spike_times(response.spikes, out.clock)}};
    return out;
}

Result<FitResult> fit_presses(const SpikeRecording& recorded, const std::string& free, const std::vector<std::string>& bounds = {}) {
    const auto start = nerve_plan({});
    const auto problem = value_or_throw(make_spike_problem({recorded}, {.is_irregular = start.traits().is_irregular}));
    ThreadPool pool(2);
    const auto parameters = value_or_throw(free_parameters(start, std::vector<std::string>{free}, bounds));
    return fit(*problem, start, parameters, pool, {.points = 40, .starts = 3, .evaluations = 60});
}

TEST(IrregularFit, AnAfferentWithJitterIsIrregular) {
    EXPECT_TRUE(nerve_plan({}).traits().is_irregular);
    EXPECT_FALSE(nerve_plan({"sa1-nerve.jitter=0"}).traits().is_irregular);
    EXPECT_FALSE(test::applied_or_throw(plan_afferent("sa1", {})).traits().is_irregular);
}

// If each interval contained the true value with a probability of 95 %, fewer than 8 of 10 would have a probability of 1 %.
TEST(IrregularFit, IntervalsContainTheKnownParameter) {
    int inside = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto result = value_or_throw(fit_presses(presses({"sa1-nerve.F_0=30m"}, seed), "F_0"));
        const auto& p = result.parameters[0];
        EXPECT_NEAR(p.value / 30e-3, 1, 0.5) << "seed " << seed;
        ASSERT_TRUE(p.low.has_value()) << "seed " << seed;
        inside += *p.low <= 30e-3 && 30e-3 <= *p.high;
        EXPECT_LT(*p.high / *p.low, 3) << "seed " << seed;
    }
    EXPECT_GE(inside, 8);
}

TEST(IrregularFit, RefusesJitterWithTheReason) {
    const auto result = fit_presses(presses({}, 1), "jitter");
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("fit it to the measure isi_cv"), std::string::npos) << result.error().message;
}

TEST(IrregularFit, JitterIsFittedToTheVariationOfIntervals) {
    const test::TemporaryFolder folder;
    const auto rows_with = [&](double value) {
        auto rows = value_or_throw(read_targets(folder.write("t.csv", fmt::format("stimulus,settings,measure,value,low,high\n"
                                                                                  "ramp-hold,F_max=1N; t_hold=3s,isi_cv@plateau,{},{},{}\n",
                                                                                  value, 0.95 * value, 1.05 * value))));
        return value_or_throw(make_target_problem(std::move(rows), {.rate = 1e3}));
    };
    const double known = value_or_throw(rows_with(1)->rows(nerve_plan({"sa1-nerve.jitter=0.15"})))[0].fitted;
    const auto problem = rows_with(known);
    const auto start = nerve_plan({});
    const auto parameters = value_or_throw(free_parameters(start, {}, std::vector<std::string>{"jitter=0.02:0.33"}));
    ThreadPool pool(2);
    const auto result = value_or_throw(fit(*problem, start, parameters, pool, {.points = 20, .starts = 2, .evaluations = 40}));
    EXPECT_NEAR(result.parameters[0].value, 0.15, 0.01);
}

}  // namespace
}  // namespace corpuscle
