// The public interfaces of sweeps and comparisons.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "corpuscle/compare.hpp"
#include "corpuscle/respond.hpp"
#include "corpuscle/sweep.hpp"
#include "support/support.hpp"

namespace {

using corpuscle::test::TemporaryFolder;

const std::string grid = R"(afferent = "sa1"
force = "press"
measures = ["spikes"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N"]
)";

TEST(SweepInterface, RecordsAreThoseOfTheRuns) {
    const TemporaryFolder folder;
    const corpuscle::SweepSettings settings{.results = (folder / "x.sqlite")};
    const auto records = corpuscle::sweep_text(grid, settings);
    ASSERT_EQ(records.items(), (std::vector<std::int64_t>{0, 1}));
    EXPECT_EQ(records.axes()[0].unit, "N");
    EXPECT_EQ(records.axis_values(0), (std::vector{1.0, 2.0}));
    for (std::size_t k = 0; k < 2; ++k) {
        const auto expected =
            corpuscle::respond_to("press", {.afferents = {"sa1"}, .settings = {k == 0 ? "press.F_max=1N" : "press.F_max=2N"}});
        EXPECT_EQ(records.measure_values(0)[k], static_cast<double>(expected.times.size()));
    }
    EXPECT_EQ(nlohmann::json::parse(records.summary())["items"], 2);
    EXPECT_EQ(corpuscle::SweepRecords(records.results()).measure_values(0), records.measure_values(0));
    EXPECT_THROW(records.axis_values(1), corpuscle::InputError);
}

TEST(SweepInterface, AStoppedSweepIsResumed) {
    const TemporaryFolder folder;
    auto text = grid;
    text.replace(text.find("list"), 4, "count = 2000\nfrom = \"1N\"\nto = \"2N\"\n#");
    corpuscle::SweepSettings settings{.results = (folder / "x.sqlite"), .progress = [](double) { return false; }};
    EXPECT_THROW(corpuscle::sweep_text(text, settings), corpuscle::InterruptedError);
    double last = 0;
    settings.progress = [&](double fraction) { return last = fraction, true; };
    EXPECT_EQ(corpuscle::sweep_text(text, settings).items().size(), 2000U);
    EXPECT_EQ(last, 1);
}

TEST(CompareInterface, ComparesResponses) {
    const auto one = corpuscle::respond_to("press", {.afferents = {"sa1"}});
    const auto trains = corpuscle::trains_of(one);
    auto later = trains;
    for (auto& t : later[0].times) t += 1e-3;
    const auto difference = corpuscle::compare(trains, later);
    EXPECT_EQ(difference.total.matched, one.times.size());
    EXPECT_NEAR(difference.total.rms_shift, 1e-3, 1e-9);
    EXPECT_NE(difference.text.find("Victor-Purpura"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(difference.document)["pairs"].size(), 1U);
    later[0].times.push_back(std::nan(""));
    EXPECT_THROW(corpuscle::compare(trains, later), corpuscle::InputError);
    EXPECT_THROW(corpuscle::compare(trains, trains, {.window = -1}), corpuscle::InputError);
}

}  // namespace
