// Calibration of trims: the limits of a chip, and the search for known codes.

#include "sweep/calibrate/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "support/support.hpp"

namespace corpuscle {
namespace {

/// A netlist that fires once: under a force of 2 N/s its node reaches the level at 0.5 s * (1 mA/N) / g. The limits allow one spike within
/// `tolerance` of `target_time` (s).
ChipCalibration ramp(const test::TemporaryFolder& folder, double target_time, double tolerance) {
    const auto path = std::filesystem::path(folder / "ramp.cir");
    std::ofstream(path) << "a ramp\n.param g=1m\niin 0 a force {g}\nra a 0 1k\nca a 0 1p\n.spike v(a) 1\n.end\n";
    ChipCalibration out;
    out.netlist = path.string(), out.T = 1e-2, out.threads = 1;
    for (int k = 0; k <= 100; ++k) out.force.push_back(2 * 1e-2 * k);
    const TimeWindow window[] = {{0, 1}};
    const double spike[] = {target_time};
    out.limits = FiringLimits::around(spike, window, tolerance);
    return out;
}

TEST(Calibrate, FindsTheKnownCode) {
    for (const auto& [target_time, tolerance, bits, trim_change] :
         {std::tuple{0.4, 4e-3, 3, 0.25}, {0.5, 4e-3, 0, 0.0}, {0.25, 4e-3, 1, 1.0}, {0.8, 2e-3, 4, -0.375}}) {
        const test::TemporaryFolder folder;
        auto calibration = ramp(folder, target_time, tolerance);
        calibration.bits = 6;
        const auto trim = trim_of(calibration.netlist, {}, {"g"}, 1, false);
        ASSERT_TRUE(trim) << trim.error().text();
        EXPECT_DOUBLE_EQ(trim->designed, 1e-3);
        calibration.trims = {*trim};
        const auto done = calibrate(calibration, {circuit::ChipSample{1, 0}});
        ASSERT_TRUE(done) << done.error().text();
        const auto& chip = done->at(0);
        EXPECT_EQ(chip.bits, bits) << target_time;
        EXPECT_EQ(chip.codes.back().at(0), trim_change * 32) << target_time;
        ASSERT_EQ(chip.spikes.size(), 1U);
        EXPECT_NEAR(chip.spikes[0], 0.5 / (1 + trim_change), 1e-4);
        EXPECT_LE(chip.presses, 1 + 3 * bits) << "at each width two neighbouring codes, and another step if the code changed";
    }
}

TEST(Calibrate, ReportsTargetsOutOfRange) {
    const test::TemporaryFolder folder;
    auto calibration = ramp(folder, 0.15, 4e-3);  // the largest code doubles g, which gives a spike at 0.25 s
    calibration.bits = 4;
    calibration.trims = {*trim_of(calibration.netlist, {}, {"g"}, 1, false)};
    const auto done = calibrate(calibration, {circuit::ChipSample{1, 0}, circuit::ChipSample{1, 1}});
    ASSERT_TRUE(done);
    const CalibrationResult report{calibration.trims, *done};
    EXPECT_EQ(report.count_within_limits(4), 0U);
    EXPECT_EQ(done->at(1).bits, -1);
    EXPECT_EQ(done->at(1).codes.back().at(0), 8) << "as close as possible";
    EXPECT_LT(done->at(1).distance.back(), done->at(1).distance.front());
    EXPECT_NE(format_calibration(calibration, {report}).find("0.0 %"), std::string::npos);
}

TEST(Calibrate, RefusesTrimsThatAreNotNumbers) {
    const test::TemporaryFolder folder;
    auto calibration = ramp(folder, 0.4, 1e-3);
    for (const char* wrong : {"h", "ra.w", "zz.m", ""}) {
        const auto trim = trim_of(calibration.netlist, {}, {wrong}, 1, false);
        ASSERT_FALSE(trim) << wrong;
        EXPECT_NE(trim.error().message.find(wrong), std::string::npos);
    }
}

TEST(Calibrate, CodesAreCentredOnTheDesignValueAndColumnsAreIntegers) {
    const Trim current{{"i"}, 8, 0.5, false}, columns{{"x.m"}, 12, 0.5, true};
    EXPECT_DOUBLE_EQ(current.value(0, 4), 8);
    EXPECT_DOUBLE_EQ(current.value(8, 4), 12);
    EXPECT_DOUBLE_EQ(current.value(-7, 4), 8 * (1 - 7.0 / 16));
    EXPECT_DOUBLE_EQ(columns.value(1, 4), 13);  // 12.75
    EXPECT_DOUBLE_EQ((Trim{{"x.m"}, 1, 1, true}.value(-7, 4)), 1) << "at least one column";
}

TEST(FiringLimits, AllowDeviationsFromTheSpikesOfAModel) {
    const std::vector<double> model = {0.31, 0.33, 0.35, 0.40, 0.44, 0.5, 0.55, 0.6, 0.65, 0.66, 0.67, 0.68};
    const TimeWindow phases[] = {{0, 0.3}, {0.3, 0.38}, {0.38, 0.7}, {0.7, 1}};
    const auto limits = FiringLimits::around(model, phases, 10e-3);
    EXPECT_TRUE(limits.are_met(model));
    EXPECT_LT(limits.distance(model), 1e-20);
    auto other = model;
    other.insert(other.begin(), 0.1);
    EXPECT_FALSE(limits.are_met(other)) << "no spike is allowed before the force";
    other = model, other.push_back(0.9);
    EXPECT_TRUE(limits.are_met(other)) << "one spike more is allowed after the last spike of the model";
    other.push_back(0.95);
    EXPECT_FALSE(limits.are_met(other));
    other.assign(model.begin() + 2, model.end());
    EXPECT_FALSE(limits.are_met(other)) << "two of three are missing, and the first is late";
    EXPECT_FALSE(limits.are_met({}));
    EXPECT_GT(limits.distance({}), limits.distance(other));
}

TEST(FiringLimits, EachSpikeIsSpreadOverItsInterval) {
    const double spikes[] = {1, 2, 4};
    EXPECT_DOUBLE_EQ(spread_count(spikes, {0, 5}), 3);
    EXPECT_DOUBLE_EQ(spread_count(spikes, {1.5, 3}), 0.5 + 0.5);
    EXPECT_DOUBLE_EQ(spread_count(spikes, {3, 5}), 0.5 + 1);
    EXPECT_DOUBLE_EQ(spread_count({}, {0, 5}), 0);
}

}  // namespace
}  // namespace corpuscle
