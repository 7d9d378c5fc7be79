// The thesis's chips at many operating conditions on SIMD lanes: the spikes of one chip at a time, and where they fire.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reproduction/thesis/chip_conditions.hpp"
#include "reproduction/thesis/press.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

constexpr const char *chips[] = {"sa1-circuit", "fa1-circuit"}, *corners[] = {"tt", "ss", "ff", "sf", "fs"};

std::vector<ConditionResponse> run_all(const std::string& chip, const std::vector<ChipCondition>& conditions) {
    return value_or_throw(run_conditions(chip, conditions, [](std::size_t) { return true; }));
}

std::string text(const ChipCondition& c) { return fmt::format("{}, {} V, {} C", c.corner, c.supply, c.celsius); }

TEST(ChipConditions, GiveTheSpikesOfOneChipAtATime) {
    const std::vector<ChipCondition> conditions = {{"tt"}, {"ff", 0.6, 85}, {"ss", 0.65, -20, false}, {"sf", 0.5, 100}};
    for (const std::string chip : chips) {
        const auto responses = run_all(chip, conditions);
        ASSERT_EQ(responses.size(), conditions.size());
        for (std::size_t k = 0; k < conditions.size(); ++k) {
            const auto& c = conditions[k];
            const auto trial = value_or_throw(
                run_trial({chip,
                           "press",
                           {fmt::format("{}.corner={}", chip, c.corner), fmt::format("{}.supply={}", chip, c.supply),
                            fmt::format("{}.temp={}", chip, c.celsius), fmt::format("{}.hv_membrane={:d}", chip, c.high_threshold)}}));
            EXPECT_TRUE(responses[k].condition == c);
            ASSERT_EQ(responses[k].spikes.size(), trial.spikes.size()) << chip << ", " << text(c);
            for (std::size_t i = 0; i < trial.spikes.size(); ++i)  // lanes are within the tolerance of the steps, not to the last bit
                EXPECT_NEAR(responses[k].spikes[i], trial.spikes[i], 0.1e-3) << chip << ", " << text(c);
            EXPECT_EQ(responses[k].range_warnings, trial.range_warnings) << chip << ", " << text(c);
            EXPECT_EQ(responses[k].error, "");
        }
    }
}

/// The chips are silent at rest and fire while the force rises: in all corners at 27 C and 0.7 V, and there from -20 to 85 C and from 0.6
/// to 0.8 V, all with one membrane capacitance. SA-I also fires in the plateau's last 100 ms, FA-I while the force falls.
TEST(ChipConditions, BothChipsFireInAllCornersOverTemperatureAndSupply) {
    std::vector<ChipCondition> conditions;
    for (const char* corner : corners)
        for (const auto& [supply, celsius] : {std::pair(0.7, 27.0),
                                              {0.7, -20.0},
                                              {0.7, 0.0},
                                              {0.7, 50.0},
                                              {0.7, 85.0},
                                              {0.6, 27.0},
                                              {0.65, 27.0},
                                              {0.75, 27.0},
                                              {0.8, 27.0}})
            conditions.push_back({corner, supply, celsius});
    for (const std::string chip : chips)
        for (const auto& r : run_all(chip, conditions)) {
            const auto where = chip + ", " + text(r.condition);
            EXPECT_EQ(press::spike_count(r.spikes, press::rest), 0) << where;
            EXPECT_GT(press::spike_count(r.spikes, press::protraction), 0) << where;
            EXPECT_GT(press::spike_count(r.spikes, chip[0] == 's' ? press::plateau_end : press::retraction), 0) << where;
        }
}

TEST(ChipConditions, StopWhenProgressSaysSo) {
    const auto stopped = run_conditions("fa1-circuit", {{"tt"}, {"ss"}, {"ff"}}, [](std::size_t) { return false; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(ChipConditions, AnUnknownChipOrCornerIsAnError) {
    EXPECT_FALSE(run_conditions("no-chip", {{"tt"}}, [](std::size_t) { return true; }));
    const auto corner = run_conditions("fa1-circuit", {{"xx"}}, [](std::size_t) { return true; });
    ASSERT_FALSE(corner);
    EXPECT_NE(corner.error().text().find("xx"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
