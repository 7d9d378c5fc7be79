// The trials of the study nerve: many copies of an afferent under graded force, and its responses to vibration.

#include "reproduction/nerve/graded_trials.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reproduction/nerve/vibration_response.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(NerveTrials, CopiesFireAsTheAfferentAloneUnderTheScaledForce) {
    const double factors[] = {0.3, 0.5, 1};
    const auto copies = test::value_or_throw(simulate_factors({"fa2", "press", {"press.F_max=4", "press.F_min=0.5"}}, factors));
    for (std::size_t k = 0; k < 3; ++k) {
        const auto alone = test::value_or_throw(simulate_train(
            {"fa2", "press", {fmt::format("press.F_max={}", 4 * factors[k]), fmt::format("press.F_min={}", 0.5 * factors[k])}}));
        ASSERT_FALSE(alone.empty());
        ASSERT_EQ(copies[k].size(), alone.size()) << factors[k];
        for (std::size_t s = 0; s < alone.size(); ++s) EXPECT_NEAR(copies[k][s], alone[s], 1e-9);
    }
}

TEST(NerveTrials, CopiesOfAnIrregularAfferentDiffer) {
    const double factors[] = {1, 1};
    const auto copies = test::value_or_throw(simulate_factors({"sa1-nerve", "press"}, factors));
    ASSERT_GT(copies[0].size(), 5u);
    EXPECT_NE(copies[0], copies[1]);
}

TEST(NerveTrials, CopiesHaveTheParametersOfTheTrial) {
    const double factors[] = {1};
    const auto spikes = [&](const char* F_0) {
        return test::value_or_throw(simulate_factors({"fa1-nerve", "press", {std::string("fa1-nerve.F_0=") + F_0}}, factors))[0].size();
    };
    EXPECT_GT(spikes("20uN"), 0u);
    EXPECT_EQ(spikes("1N"), 0u);
}

TEST(NerveTrials, AnErrorOfTheStimulusIsPassedOn) {
    const double factors[] = {1};
    EXPECT_FALSE(simulate_factors({"sa1-nerve", "prss"}, factors));
    EXPECT_FALSE(simulate_factors({"sa1-nrve", "press"}, factors));
}

TEST(NerveTrials, AGeometricSeriesReachesItsEnd) {
    const auto series = geometric_series(1, 8, 2);
    ASSERT_EQ(series.size(), 4u);
    EXPECT_DOUBLE_EQ(series.front(), 1);
    EXPECT_DOUBLE_EQ(series.back(), 8);
    EXPECT_GE(geometric_series(1, 9, 2).back(), 9);
}

/// Responses at amplitudes of 1, 2, 3 ... N.
VibrationResponse responses(double f, const std::vector<CycleResponse>& list) {
    VibrationResponse out{f, list, 1};
    for (std::size_t k = 0; k < list.size(); ++k) out.responses[k].amplitude = static_cast<double>(k + 1);
    return out;
}

TEST(NerveTrials, TheThresholdIsTheLeastAmplitudeWithASpikeACycle) {
    EXPECT_EQ(responses(10, {{0, 0.5}, {0, 1}, {0, 2}}).threshold(), 2);
    EXPECT_TRUE(std::isnan(responses(10, {{0, 0.5}, {0, 0.9}}).threshold()));
}

TEST(NerveTrials, TheDetectionThresholdIsTheLeastAmplitudeWithASpike) {
    EXPECT_EQ(responses(10, {{0, 0}, {0, 0.1}, {0, 1}}).detection_threshold(), 2);
    EXPECT_TRUE(std::isnan(responses(10, {{0, 0}, {0, 0}}).detection_threshold()));
}

TEST(NerveTrials, ThePlateauIsTheWidestRangeWithoutAGap) {
    const auto p =
        responses(10,
                  {{0, 1, true, 0.5}, {0, 1, false, 0.1}, {0, 1, true, 0.99}, {0, 1, true, 0.95}, {0, 2, false, 0.2}, {0, 1, true, 0.3}})
            .plateau();
    EXPECT_EQ(p.low, 3);
    EXPECT_EQ(p.high, 4);
    EXPECT_EQ(p.min_vector_strength, 0.95);
    EXPECT_TRUE(std::isnan(responses(10, {{0, 1, false, 1}}).plateau().low));
}

TEST(NerveTrials, TheMostExcitableFrequencyIsTheMiddleOfThoseWithTheMostSpikes) {
    const VibrationResponse all[] = {responses(5, {{0, 0}, {0, 3}}), responses(10, {{0, 1}, {0, 2}}), responses(20, {{0, 0.2}, {0, 1}}),
                                     responses(40, {{0, 1}, {0, 1}})};
    EXPECT_NEAR(most_excitable(all, 1), 20, 1e-9);
    EXPECT_NEAR(most_excitable(all, 2.5), 5, 1e-9);
    EXPECT_TRUE(std::isnan(most_excitable(all, 0.5)));
}

TEST(NerveTrials, AFastAdaptingAfferentFollowsFlutterOneToOne) {
    const auto v = test::value_or_throw(vibrate("fa1-nerve", 40, 1));
    const auto p = v.plateau();
    EXPECT_GT(p.high / p.low, 3);
    EXPECT_NEAR(p.low, v.threshold(), 0.1 * p.low);
    EXPECT_GT(p.min_vector_strength, 0.9);
    EXPECT_EQ(v.spikes_per_cycle(p.high), 1);
    EXPECT_EQ(v.spikes_per_cycle(20e-6), 0);
    EXPECT_LT(v.spikes_per_cycle(0.5 * p.low), 1);
    EXPECT_GT(v.shortest_interval, 1e-3 - 1e-12);
}

}  // namespace
}  // namespace corpuscle
