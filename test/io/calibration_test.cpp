// The calibration of a sensor by its readings at zero force and under a load.

#include "io/recording/calibration.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/random.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::load_recording, test::TemporaryFolder, test::try_load_recording, test::value_or_throw;

RecordingOptions calibrated(const std::vector<std::string>& texts) {
    RecordingOptions options;
    for (const auto& text : texts) options.calibrations.push_back(value_or_throw(parse_calibration(text)));
    return options;
}

/// 4 s at 100 Hz: 1 s at zero, then the load. Channel b has half the step of channel a and the other sign.
std::string two_channels(double noise = 0) {
    std::string text = "time_s,a,b\n";
    for (std::uint32_t k = 0; k < 400; ++k) {
        const double step = k < 100 ? 0 : 1000, z = noise * normal_pair(3, k, 0, 0).first;
        text += fmt::format("{:.2f},{:.9g},{:.9g}\n", 0.01 * k, 500 + step + z, 200 - step / 2 + z);
    }
    return text;
}

TEST(Calibration, GivesTheForceOfTheLoadAndZero) {
    EXPECT_TRUE(rc::check("two readings", [] {
        const int zero = *rc::gen::inRange(-2000, 2000), step = *rc::gen::suchThat(rc::gen::inRange(-2000, 2000), [](int n) { return n != 0; });
        const double load = 0.1 * *rc::gen::inRange(1, 100);
        const TemporaryFolder folder;
        folder.write("a.csv", fmt::format("{}\n{}\n{}\n", zero, zero + step, zero + 2 * step));
        auto options = calibrated({fmt::format("zero={},load={}@{}N", zero, zero + step, load)});
        options.rate = 100;
        const auto force = load_recording(folder / "a.csv", options).force[0];
        for (int k = 0; k < 3; ++k) RC_ASSERT(std::abs(force[static_cast<std::size_t>(k)] - k * load) < 1e-9 * load * 3);
    }));
}

TEST(Calibration, MeasuresEachChannelInItsOwnWindows) {
    const TemporaryFolder folder;
    folder.write("a.csv", two_channels());
    const auto loaded = load_recording(folder / "a.csv", calibrated({"zero=0s..1s,load=2s..3s@2N"}));
    for (const auto& force : loaded.force) {
        EXPECT_NEAR(force[50], 0, 1e-12);
        EXPECT_NEAR(force[350], 2, 1e-12);
    }
    EXPECT_NE(std::find(loaded.notes.begin(), loaded.notes.end(), "'a' was calibrated: the same as --offset 500 --scale 0.002"),
              loaded.notes.end());
    EXPECT_NE(std::find(loaded.notes.begin(), loaded.notes.end(), "'b' was calibrated: the same as --offset 200 --scale -0.004"),
              loaded.notes.end());
    const auto own = load_recording(folder / "a.csv", calibrated({"zero=500,load=1500@1N", "b:zero=200,load=0@3N"}));
    EXPECT_NEAR(own.force[0][350], 1, 1e-12);
    EXPECT_NEAR(own.force[1][350], 3 * 500.0 / 200, 1e-12);
}

TEST(Calibration, IsTheSameAsTheOffsetAndScaleThatItPrints) {
    const TemporaryFolder folder;
    folder.write("a.csv", two_channels());
    auto options = calibrated({"zero=0s..1s"});
    options.scale = 0.002;
    const auto loaded = load_recording(folder / "a.csv", options);
    EXPECT_NEAR(loaded.force[0][350], 2, 1e-12);
    EXPECT_NEAR(loaded.force[1][350], -1, 1e-12);
    RecordingOptions typed;
    typed.offset = 500, typed.scale = 0.002;
    EXPECT_EQ(load_recording(folder / "a.csv", typed).force[0],
              load_recording(folder / "a.csv", calibrated({"zero=0s..1s,load=1s..4s@2N"})).force[0]);
}

TEST(Calibration, HasTheStandardErrorOfNoisyReadings) {
    const TemporaryFolder folder;
    folder.write("a.csv", two_channels(10));
    const auto loaded = load_recording(folder / "a.csv", calibrated({"zero=0s..1s,load=1s..2s@2N"}));
    EXPECT_NEAR(loaded.force[0][350], 2, 0.1);
    // The standard error of a mean of 100 readings is 1, of the step 1.4 in 1000.
    EXPECT_NE(loaded.notes[0].find("(standard error 2."), std::string::npos) << loaded.notes[0];
    EXPECT_TRUE(loaded.quality.warnings.empty() || loaded.quality.warnings.back().find("noise of the readings") == std::string::npos);
    folder.write("b.csv", two_channels(3000));
    const auto noisy = load_recording(folder / "b.csv", calibrated({"zero=0s..1s,load=1s..2s@2N"}));
    const auto& warnings = noisy.quality.warnings;
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) {
        return w.find("is larger than the step") != w.npos && w.find("standard error") != w.npos;
    }));
}

TEST(Calibration, RefusesWhatCannotBe) {
    const TemporaryFolder folder;
    folder.write("a.csv", two_channels());
    const auto error_of = [&](const std::vector<std::string>& texts, std::optional<double> scale = {}, double offset = 0) {
        auto options = calibrated(texts);
        options.scale = scale, options.offset = offset;
        const auto loaded = try_load_recording(folder / "a.csv", options);
        return loaded ? std::string("no error") : loaded.error().text();
    };
    EXPECT_NE(error_of({"zero=5,load=5@2N"}).find("reads 5 both at zero and under the load"), std::string::npos);
    EXPECT_NE(error_of({"zero=0s..1s,load=9s..10s@2N"}).find("load=9s..10s: there is no reading in this window; the recording lasts from 0 s"),
              std::string::npos);
    EXPECT_NE(error_of({"c:zero=5"}).find("--calibrate c: there is no such channel"), std::string::npos);
    EXPECT_NE(error_of({"zero=5,load=6@2N"}, 0.1).find("--scale and the load of --calibrate exclude each other"), std::string::npos);
    EXPECT_NE(error_of({"zero=5"}, 0.1, 3).find("--offset and --calibrate exclude each other"), std::string::npos);
    for (const auto* text : {"", "zero", "zero=", "zero=x", "zero=1,load=2", "zero=1,load=2@", "zero=1,load=2@0N", "zero=1,load=2@3s",
                             "load=2@1N", "zero=2s..1s", "zero=1,zero=2", ":zero=1", "zero=1..2..3"}) {
        const auto parsed = parse_calibration(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_NE(parsed.error().message.find("zero=812,load=2140@2N"), std::string::npos);
    }
}

}  // namespace
}  // namespace corpuscle
