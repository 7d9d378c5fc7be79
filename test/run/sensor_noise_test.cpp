// The warning about the noise of a sensor, and that its remedies work.

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;

/// A recording in N at 100 Hz: 3 s of rest, a press of 1 N for 3 s, 3 s of rest; with noise of this standard deviation (N).
std::string press_with_noise(double deviation) {
    std::string text = "F_N\n";
    for (std::uint32_t k = 0; k < 900; ++k) {
        const double press = k < 300 ? 0 : k < 320 ? (k - 300) / 20.0 : k < 600 ? 1 : k < 620 ? (620 - k) / 20.0 : 0;
        text += fmt::format("{:.6f}\n", press + deviation * normal_pair(3, k, 1, 0).first);
    }
    return text;
}

/// Numbers of spikes of a class at rest, in the first second of the press, and in its last second.
struct PressCounts {
    int rest = 0, onset = 0, hold = 0;
};

PressCounts press_counts(const TemporaryFolder& folder, const std::string& afferent) {
    PressCounts out;
    std::istringstream text(test::read_file(folder / "out/spikes.csv"));
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with(afferent + ",")) continue;
        const double t = std::stod(line.substr(line.rfind(',') + 1));
        out.rest += t < 2.95 || t > 6.5, out.onset += t >= 2.95 && t < 4, out.hold += t >= 4.5 && t < 5.9;
    }
    return out;
}

TEST(SensorNoise, IsReportedIfItIsEnoughForSpikesAndBothRemediesMakeRestSilent) {
    const TemporaryFolder folder;
    folder.write("press.csv", press_with_noise(4e-3));
    const std::string command = "respond press.csv --rate 100Hz --afferent sa1,fa1-nerve,sa1-nerve --out out --overwrite ";
    const auto first = run_program(folder, command);
    EXPECT_NE(first.err.find("the noise of the sensor, about "), std::string::npos) << first.err;
    const std::string remedy =
        "Use --zero 500ms --deadband auto if nothing touches the sensor in the first half second, otherwise --deadband ";
    const auto at = first.err.find(remedy);
    ASSERT_NE(at, std::string::npos) << first.err;
    EXPECT_GT(press_counts(folder, "fa1-nerve").rest, 50);
    const auto band = first.err.substr(at + remedy.size(), first.err.find('\n', at) - at - remedy.size());
    for (const auto& options : {std::string("--zero 500ms --deadband auto"), "--deadband " + band}) {
        const auto second = run_program(folder, command + options);
        ASSERT_EQ(second.status, 0) << options << second.err;
        EXPECT_EQ(second.err.find("the noise of the sensor"), std::string::npos) << options << second.err;
        const auto fast = press_counts(folder, "fa1-nerve"), slow = press_counts(folder, "sa1-nerve");
        EXPECT_EQ(fast.rest + slow.rest, 0) << options;
        EXPECT_EQ(fast.hold, 0) << options;
        EXPECT_GT(fast.onset, 2) << options;
        EXPECT_GT(slow.hold, 10) << options;
    }
}

TEST(SensorNoise, IsNotReportedForQuietSensorsOrInsensitiveAfferents) {
    const TemporaryFolder folder;
    folder.write("quiet.csv", press_with_noise(0)), folder.write("noisy.csv", press_with_noise(4e-3));
    for (const std::string arguments : {"quiet.csv --afferent fa1-nerve,fa2", "noisy.csv --afferent sa1,fa1"}) {
        const auto ran = run_program(folder, "respond --rate 100Hz " + arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
        EXPECT_EQ(ran.err.find("the noise of the sensor"), std::string::npos) << arguments << ran.err;
    }
    EXPECT_NE(run_program(folder, "respond noisy.csv --rate 100Hz --population fingertip").err.find("the noise of the sensor"),
              std::string::npos);
}

}  // namespace
}  // namespace corpuscle
