// The linear read-out on features whose classes are known.

#include "reproduction/readout/linear_readout.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "core/random.hpp"

namespace corpuscle {
namespace {

constexpr std::uint32_t purpose = 1;

/// Trials of three classes in turn with features that are random numbers; `shift` is added to the feature of the trial's class.
std::vector<ReadoutTrial> random_trials(std::size_t count, std::size_t features, double shift) {
    std::vector<ReadoutTrial> out;
    for (std::uint32_t k = 0; k < count; ++k) {
        ReadoutTrial trial{{}, k % 3};
        for (std::uint32_t f = 0; f < features; ++f) trial.features.push_back(10 + normal(7, k, purpose, f));
        trial.features[trial.label] += shift;
        out.push_back(std::move(trial));
    }
    return out;
}

TEST(LinearReadout, ReadsClassesThatDifferInTheMeanOfOneFeature) { EXPECT_EQ(readout_accuracy(random_trials(60, 5, 20), 5, 3), 1); }

TEST(LinearReadout, IsAtChanceIfFeaturesSayNothingAlthoughThereAreMoreFeaturesThanTrials) {
    const double chance = readout_accuracy(random_trials(300, 600, 0), 5, 3);
    EXPECT_NEAR(chance, 1.0 / 3, 3 * std::sqrt(2.0 / 9 / 300));  // three standard deviations
}

TEST(LinearReadout, IsBetweenChanceAndCertaintyForClassesThatOverlap) {
    // For three normal classes at the corners of a triangle of side d = shift * sqrt(2), the best read-out errs in some of the trials.
    const double accuracy = readout_accuracy(random_trials(600, 3, 1.5), 5, 3);
    EXPECT_GT(accuracy, 0.70);
    EXPECT_LT(accuracy, 0.85);
}

TEST(LinearReadout, DoesNotDependOnTheScaleOrOffsetOfAFeature) {
    auto trials = random_trials(90, 4, 1);
    const double before = readout_accuracy(trials, 3, 3);
    for (auto& t : trials) t.features[1] = 1e4 * t.features[1] - 3e5, t.features.push_back(5);  // the last feature is constant
    EXPECT_EQ(readout_accuracy(trials, 3, 3), before);
}

TEST(LinearReadout, ReadsATrialOnlyFromOthers) {
    // Each block of trials has features of its own, which no other block shares: nothing can be learned about a block that is left out.
    std::vector<ReadoutTrial> trials;
    for (std::size_t k = 0; k < 30; ++k) {
        ReadoutTrial trial{std::vector<double>(30), k % 3};
        trial.features[k] = 1;
        trials.push_back(std::move(trial));
    }
    EXPECT_LE(readout_accuracy(trials, 10, 3), 0.4);
}

TEST(LinearReadout, SaysForEachTestedTrialWhetherItIsReadCorrectly) {
    auto learned = random_trials(60, 3, 20), tested = random_trials(6, 3, 20);
    tested[4].label = 2;  // its features are those of class 1
    std::vector<const ReadoutTrial*> from, to;
    for (const auto& t : learned) from.push_back(&t);
    for (const auto& t : tested) to.push_back(&t);
    EXPECT_EQ(read_correctly(from, to), (std::vector<bool>{true, true, true, true, false, true}));
    for (auto* trials : {&learned, &tested})
        for (auto& t : *trials) t.features.assign(3, 0);  // silent afferents
    EXPECT_EQ(read_correctly(from, to), (std::vector<bool>{true, false, false, true, false, false})) << "the first class is read";
}

}  // namespace
}  // namespace corpuscle
