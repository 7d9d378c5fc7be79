// A sweep over a plain grid reports the effect of every axis, and no statistics that only make sense for random samples.

#include "sweep/stats/sweep_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/support.hpp"
#include "sweep/parallel/run_sweep.hpp"
#include "sweep/stats/sweep_summary.hpp"

namespace corpuscle {
namespace {

using test::run_program;
using test::TemporaryFolder;
using test::value_or_throw;

constexpr const char* grid_file = R"(afferent = "sa1"
force = "press"
measures = ["spikes", "peak_rate", "first_spike"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N", "3N", "4N"]
[[vary]]
what = "sa1.f_B"
list = ["20Hz", "40Hz", "80Hz"]
)";

/// z = 10 x + y over x = 0 to 3 and y ("kind") = 0 to 2; the last item has no value.
SweepTable example_grid() {
    SweepTable out;
    out.item_count = 12, out.is_grid = true;
    out.axes = {{"x", "V"}, {"kind", "", "", {"a", "b", "c"}}}, out.measures = {{"z", ""}};
    out.axis_values.resize(2), out.measure_values.resize(1);
    for (int item = 0; item < 12; ++item) {
        out.items.push_back(item), out.ends.push_back(item == 11 ? ItemEnd::diverged : ItemEnd::done);
        out.axis_values[0].push_back(item / 3), out.axis_values[1].push_back(item % 3);
        out.measure_values[0].push_back(item == 11 ? std::nan("") : 10.0 * (item / 3) + item % 3);
    }
    out.points = {{0, 1, 2, 3}, {0, 1, 2}};
    return out;
}

TEST(PlainGrid, EffectsAreTheMeansAtEachValueAndTheirFractionOfTheVariance) {
    auto table = example_grid();
    table.measure_values[0][11] = 32, table.ends[11] = ItemEnd::done;
    const auto effects = axis_effects(table, table.measure_values[0]);
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_EQ(effects[0].axis, 0U);
    EXPECT_EQ(effects[0].means, (std::vector<double>{1, 11, 21, 31}));
    EXPECT_EQ(effects[1].means, (std::vector<double>{15, 16, 17}));
    EXPECT_NEAR(effects[0].fraction, 125 / (125 + 2.0 / 3), 1e-12) << "variances of 10 x and of y";
    EXPECT_NEAR(effects[0].fraction + effects[1].fraction, 1, 1e-12);
    EXPECT_EQ(means_over(table, table.measure_values[0], 1, 0)[2], (std::vector<double>{2, 12, 22, 32}));
    EXPECT_EQ(point_label(table, 11), "x = 3 V, kind = c");
}

TEST(PlainGrid, WithAMissingItemHasTheEffectsOfTheOthers) {
    const auto table = example_grid();
    const auto effects = axis_effects(table, table.measure_values[0]);
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_EQ(effects[0].means.back(), 30.5);
    EXPECT_TRUE(std::isnan(means_over(table, table.measure_values[0], 0, 1)[3][2]));
    EXPECT_TRUE(axis_effects(table, std::vector<double>(12, 5)).empty());
}

TEST(PlainGrid, ReportsEveryAxisAndNoStatisticsOfChance) {
    const TemporaryFolder folder;
    folder.write("grid.toml", grid_file);
    ASSERT_EQ(run_program(folder, "sweep grid.toml --out r.sqlite --quiet").status, 0);
    const auto shown = run_program(folder, "sweep show r.sqlite");
    ASSERT_EQ(shown.status, 0) << shown.err;
    for (const auto* expected_text : {"Grid of press.F_max (4 values) by sa1.f_B (3 values)", "Effect of each axis", "press.F_max",
                                      "sa1.f_B", "20 Hz", "80 Hz", "press.F_max = 4 N, sa1.f_B = 20 Hz"})
        EXPECT_NE(shown.out.find(expected_text), std::string::npos) << expected_text << "\n" << shown.out;
    for (const auto* statistic : {"95 %", "normal", "+-", "±", "chips", "sigma", "chance for"})
        EXPECT_EQ(shown.out.find(statistic), std::string::npos) << statistic << "\n" << shown.out;
    const auto document = nlohmann::json::parse(run_program(folder, "sweep show r.sqlite --json").out);
    EXPECT_TRUE(document["grid"].get<bool>());
    ASSERT_EQ(document["depends_on"].size(), 3U);
    for (const auto& d : document["depends_on"]) EXPECT_EQ(d["effects"].size(), 2U) << d;
    EXPECT_TRUE(document["all"]["measures"][0]["mean"]["low"].is_null());
    EXPECT_TRUE(document["points"][0]["measures"][0]["sigma"]["value"].is_null());
}

TEST(PlainGrid, IsNotPlainIfAnAxisIsSampled) {
    const TemporaryFolder folder;
    folder.write("drawn.toml", std::string(grid_file) + "[[vary]]\nwhat = \"sa1.f_C\"\nhow = \"uniform\"\nfrom = \"5Hz\"\nto = \"10Hz\"\n");
    ASSERT_EQ(run_program(folder, "sweep drawn.toml --samples 2 --out r.sqlite --quiet").status, 0);
    EXPECT_FALSE(is_deterministic(value_or_throw(SweepResults::open_read_only(folder / "r.sqlite"))));
    folder.write("plain.toml", grid_file);
    ASSERT_EQ(run_program(folder, "sweep plain.toml --seed 3 --out p.sqlite --quiet").status, 0);
    EXPECT_TRUE(is_deterministic(value_or_throw(SweepResults::open_read_only(folder / "p.sqlite"))));
    folder.write("step.cir", "t\nv1 a 0 1\nr1 a 0 {r}\n.param r=1k\n.step param r list 1k 2k 3k\n.op\n.meas op i find i(v1)\n");
    ASSERT_EQ(run_program(folder, "sweep step.cir --out s.sqlite --quiet").status, 0);
    EXPECT_TRUE(is_deterministic(value_or_throw(SweepResults::open_read_only(folder / "s.sqlite"))));
}

}  // namespace
}  // namespace corpuscle
