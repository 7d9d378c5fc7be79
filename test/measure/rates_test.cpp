#include "measure/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace corpuscle {
namespace {

const std::vector<double> train = {0.1, 0.2, 0.25, 0.45, 0.95};

TEST(Measures, TakeThePhasesSpikesAndTheForwardFrequency) {
    const Stretch s(train, {"hold", 0.2, 0.5});
    EXPECT_EQ(spike_count(s), 3);
    EXPECT_NEAR(mean_rate(s), 10, 1e-9);
    EXPECT_NEAR(first_rate(s), 20, 1e-9);
    EXPECT_NEAR(peak_rate(s), 20, 1e-9);
    EXPECT_NEAR(last_rate(s), 5, 1e-9) << "between the last two inside, not to the one beyond";
}

TEST(Measures, APhaseOwnsItsStartNotItsEnd) {
    EXPECT_EQ(spike_count(Stretch(train, {"", 0.1, 0.2})), 1);
    EXPECT_EQ(spike_count(Stretch(train, {"", 0.2, 0.25})), 1);
}

TEST(Measures, HaveNoValueWhereThereIsNone) {
    for (const auto& m : measures) {
        const double empty = m.of(Stretch({}, {"", 0, 1})), last = m.of(Stretch(train, {"", 0.9, 1}));
        if (m.of == spike_count || m.of == mean_rate) {
            EXPECT_EQ(empty, 0) << m.name;
            EXPECT_GT(last, 0) << m.name;
        } else {
            EXPECT_TRUE(std::isnan(empty) && std::isnan(last)) << m.name << ": the last spike of all has no frequency";
        }
    }
    EXPECT_TRUE(std::isnan(mean_rate(Stretch(train, {"", 0.5, 0.5}))));
}

TEST(Measures, TwoSpikesOnOneSampleHaveNoFrequency) {
    const std::vector<double> sampled = {0.1, 0.1, 0.2};
    const Stretch s(sampled, {"", 0, 1});
    EXPECT_TRUE(std::isnan(first_rate(s)));
    EXPECT_NEAR(peak_rate(s), 10, 1e-9);
}

TEST(Measures, InstantaneousRatesAreOneFewerThanSpikes) {
    EXPECT_EQ(instantaneous_rates(train).size(), 4U);
    EXPECT_TRUE(instantaneous_rates({}).empty());
    EXPECT_NEAR(instantaneous_rates(train)[0], 10, 1e-9);
}

}  // namespace
}  // namespace corpuscle
