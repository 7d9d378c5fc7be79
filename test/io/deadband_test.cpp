// The deadband of --deadband: its closed form, its properties, and the noise at rest from which "auto" takes the band.

#include "io/quality/filters.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/random.hpp"
#include "support/loaded_recording.hpp"
#include "support/program.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder, test::value_or_throw;

std::vector<double> through_deadband(Deadband band, const std::vector<double>& x) {
    std::vector<double> out;
    for (const double v : x) out.push_back(band.next(v));
    return out;
}

/// White noise of this standard deviation.
std::vector<double> white_samples(double deviation, std::size_t count, std::uint32_t stream) {
    std::vector<double> out(count);
    for (std::uint32_t k = 0; k < count; ++k) out[k] = deviation * normal_pair(5, k, stream, 0).first;
    return out;
}

TEST(Deadband, FollowsARiseTwoBandsBelowAndAFallExactly) {
    const std::vector<double> x = {0, 1, -1, 3, 2, 1, 1.5, 0.5, 0, 10, 0, -4, -1, 0}, y = {0, 0, 0, 1, 1, 1, 1, 0.5, 0, 8, 0, -2, -1, 0};
    EXPECT_EQ(through_deadband(Deadband(1), x), y);
    EXPECT_EQ(through_deadband(Deadband(), x), x) << "no band";
}

TEST(Deadband, NeverMovesByNoiseInsideItsBandAndStaysWithinTwoBands) {
    EXPECT_TRUE(rc::check("constant force with noise below the band, after any force", [] {
        const double band = 0.1 * *rc::gen::inRange(1, 50), level = 0.1 * *rc::gen::inRange(-100, 100);
        const auto before =
            *rc::gen::container<std::vector<double>>(rc::gen::map(rc::gen::inRange(-100, 100), [](int v) { return 0.1 * v; }));
        Deadband deadband(band);
        for (const double x : before) {
            const double y = deadband.next(x);
            RC_ASSERT(std::abs(y - x) <= 2 * band + 1e-12);
            RC_ASSERT(std::abs(y) <= std::abs(x) + 1e-12);
        }
        deadband.next(level + band), deadband.next(level - band);  // the largest noise on both sides
        const double held = deadband.next(level);
        for (const double u : white_samples(1, 100, 1)) RC_ASSERT(deadband.next(level + band * std::tanh(u)) == held);
        for (const double u : white_samples(1, 100, 2)) deadband.next(band * std::tanh(u));
        RC_ASSERT(deadband.next(0) == 0);
    }));
}

TEST(Deadband, TheNoiseIsMeasuredWithoutAFewJumps) {
    auto x = white_samples(0.3, 20'000, 3);
    EXPECT_NEAR(noise_deviation(x, 0), 0.3, 0.01);
    x = white_samples(0.3, 20'000, 3);
    for (std::size_t k = 0; k < x.size(); k += 25) x[k] = 1e6;
    EXPECT_NEAR(noise_deviation(x, 0), 0.3, 0.04);
    x = white_samples(1, 20'000, 4);
    for (double& v : x) v = std::round(v);  // a converter whose step is the noise
    EXPECT_NEAR(noise_deviation(x, 0), 1, 0.15);
    std::vector<double> constant(30, 7.0);
    EXPECT_EQ(noise_deviation(constant, 7), 0);
}

/// A recording in mN at 100 Hz: rest of noise, a press of 2 N, rest; with noise of 5 mN throughout.
std::string noisy_press() {
    std::string text;
    const auto n = white_samples(5, 1200, 6);
    for (std::size_t k = 0; k < n.size(); ++k) text += fmt::format("{:.3f}\n", 300 + n[k] + (k >= 400 && k < 800 ? 2000 : 0));
    return text;
}

TEST(Deadband, AutoMakesRestSilentAndKeepsThePress) {
    const TemporaryFolder folder;
    const auto path = folder.write("press.csv", noisy_press());
    const RecordingOptions options{.rate = 100, .unit = "mN", .zero = 0.5, .deadband = DeadbandOptions{}};
    const auto read = test::load_recording(path, options);
    const auto& force = read.force[0];
    double band = 0;
    for (const auto& m : read.quality.metrics)
        if (m.name == "deadband") band = m.value;
    EXPECT_NEAR(band, 4 * 5e-3, 6e-3);
    int steps = 0;  // while the force is held: only where the noise is higher than ever before
    for (std::size_t k = 0; k < force.size(); ++k) {
        if (k < 400 || k >= 800) {
            EXPECT_EQ(force[k], 0) << k;
        } else if (k > 420) {
            EXPECT_GE(force[k], force[k - 1]) << k;
            steps += force[k] != force[k - 1];
        }
    }
    EXPECT_LE(steps, 4);
    EXPECT_NEAR(force[500], 2 - band, band);
    EXPECT_EQ(test::load_recording(path, options, 4096).force, read.force) << "the length of blocks";
}

TEST(Deadband, ErrorsNameARemedyThatWorks) {
    const TemporaryFolder folder;
    folder.write("press.csv", noisy_press());
    const auto respond = [&](const std::string& more) {
        return run_program(folder, "respond press.csv --rate 100Hz --unit mN --afferent fa1-nerve --json " + more);
    };
    EXPECT_NE(
        respond("--deadband auto").err.find("add such a time at the beginning, at least --zero 0.2s, or give the band: --deadband 20mN"),
        std::string::npos);
    EXPECT_NE(
        respond("--deadband auto --zero 100ms").err.find("a rest period of 10 samples is too short to measure the noise; use --zero 0.2s"),
        std::string::npos);
    EXPECT_EQ(respond("--deadband auto --zero 0.2s").status, 0);
    EXPECT_EQ(respond("--deadband 20mN").status, 0);
    for (const std::string wrong : {"0N", "-1mN", "20mV", "x"})
        EXPECT_NE(respond("--deadband " + wrong).err.find("write 'auto', or a force above 0, such as 20mN"), std::string::npos) << wrong;
    const auto reported = respond("--zero 500ms --deadband auto");
    EXPECT_NE(reported.err.find("--deadband: changes within +-"), std::string::npos) << reported.err;
    EXPECT_NE(reported.out.find("\"deadband\""), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
