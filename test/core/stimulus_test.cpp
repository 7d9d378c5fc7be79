#include <cmath>

#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::RunSettings, test::force;

TEST(Stimulus, EachIsFiniteNotNegativeAndReproducible) {
    for (const auto& entry : stimulus_catalog()) {
        const std::string name(entry.name);
        const auto once = force(name), again = force(name);
        ASSERT_FALSE(once.empty()) << name;
        EXPECT_EQ(once, again) << name;
        for (const double f : once) ASSERT_TRUE(std::isfinite(f)) << name;
        if (name == "noise") continue;  // noise may be negative
        for (const double f : once) ASSERT_GE(f, 0) << name;
    }
}

TEST(Stimulus, EachIsTheSameAtEveryRate) {
    for (const auto& entry : stimulus_catalog()) {
        const std::string name(entry.name);
        const auto coarse = force(name, {.rate = 1e3}), fine = force(name, {.rate = 8e3});
        for (std::size_t k = 0; k < coarse.size(); ++k) ASSERT_NEAR(coarse[k], fine[8 * k], 1e-9) << name << " at " << k;
    }
}

TEST(Stimulus, PhasesCoverTheStimulusWithoutGaps) {
    for (const auto& entry : stimulus_catalog()) {
        const auto source = test::value_or_throw(make_stimulus(entry.name, 1e3, 0));
        double end = 0;  // of the phases so far; stays 0 if the stimulus has no phases
        for (const auto& p : source->phases()) {
            EXPECT_EQ(p.from, end) << entry.name;
            EXPECT_GE(p.to, p.from) << entry.name;
            end = p.to;
        }
        if (end > 0) {
            EXPECT_NEAR(end * 1e3, static_cast<double>(test::value_or_throw(read_channel(*source)).size()), 0.5) << entry.name;
        }
    }
}

TEST(Stimulus, PressIsTheStimulusOfTheThesis) {
    const auto f = force("press", {.rate = 1e3});
    ASSERT_EQ(f.size(), 1000U);
    EXPECT_EQ(f[0], 0.2);
    EXPECT_EQ(f[250], 0.2);
    EXPECT_NEAR(f[312], 0.2 + 1.9 * (1 - std::cos(M_PI * 62 / 125)), 1e-12);
    for (std::size_t k = 375; k <= 625; ++k) EXPECT_EQ(f[k], 4.0) << k;
    for (std::size_t k = 0; k <= 125; ++k) EXPECT_NEAR(f[250 + k], f[750 - k], 1e-12) << "retraction mirrors protraction";
    EXPECT_EQ(f[999], 0.2);
}

TEST(Stimulus, ASumAddsForcesAndLastsAsLongAsItsLongestMember) {
    const auto sum = force("press+sine", {.settings = {"sine.duration=1.5s"}}), press = force("press"),
               sine = force("sine", {.settings = {"sine.duration=1.5s"}});
    ASSERT_EQ(sum.size(), 15000U);
    for (std::size_t k = 0; k < press.size(); ++k) ASSERT_EQ(sum[k], press[k] + sine[k]);
}

TEST(Stimulus, AShorterMemberOfASumHoldsItsLastValue) {
    const auto sum = force("press+chirp", {.settings = {"chirp.duration=100ms", "chirp.F_mean=0"}}), press = force("press");
    for (std::size_t k = 0; k < sum.size(); ++k) ASSERT_LE(std::abs(sum[k] - press[k]), 0.2) << "more than the amplitude of the chirp";
    for (std::size_t k = 1001; k < sum.size(); ++k) ASSERT_NEAR(sum[k] - press[k], sum[1001] - press[1001], 1e-12);
    const auto source = test::applied_or_throw(make_stimulus("press+sine", test::parse_settings({"sine.duration=3s"}), 1e3, 0));
    EXPECT_EQ(source->phases().back().name, "after");
    EXPECT_EQ(source->phases().back().to, 3);
}

TEST(Stimulus, AChirpOfNearlyConstantFrequencyIsAccurate) {
    const auto flat = force("chirp", {.settings = {"chirp.f_from=1000Hz", "chirp.f_to=1000.000002Hz", "chirp.duration=100s"}, .rate = 1e3});
    for (std::size_t k = 0; k < flat.size(); k += 97) ASSERT_NEAR(flat[k], 1, 1e-3) << "every sample is at the same phase";
}

TEST(Stimulus, TheEdgesOfAStepAreOnSamples) {
    const auto f = force("step", {.settings = {"step.t_rest=0.1s", "step.t_hold=0.2s"}, .rate = 1e3});
    EXPECT_EQ(f[99], 0);
    EXPECT_EQ(f[100], 1);
    EXPECT_EQ(f[299], 1);
    EXPECT_EQ(f[300], 0);
}

TEST(Stimulus, NoiseDependsOnItsSeedAndHasItsStandardDeviation) {
    const RunSettings a{.settings = {"noise.duration=100s"}, .rate = 1e3, .seed = 1},
        b{.settings = {"noise.duration=100s"}, .rate = 1e3, .seed = 2};
    const auto x = force("noise", a);
    EXPECT_NE(x, force("noise", b));
    double sum = 0, square = 0;
    // Every fifth sample is a random number; those between are interpolated.
    for (std::size_t k = 0; k < x.size(); k += 5) sum += x[k], square += (x[k] - 1) * (x[k] - 1);
    const auto n = static_cast<double>(x.size() / 5);
    EXPECT_NEAR(sum / n, 1, 5 * 0.2 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(square / n), 0.2, 5 * 0.2 / std::sqrt(2 * n));
}

TEST(Stimulus, ChirpAndGratingHaveTheirStatedFrequencies) {
    const auto rises = [](const std::vector<double>& f, std::size_t from, std::size_t to, double level) {
        int n = 0;
        for (std::size_t k = from + 1; k < to; ++k) n += f[k - 1] < level && f[k] >= level;
        return n;
    };
    const auto chirp = force("chirp", {.rate = 20e3});
    EXPECT_NEAR(rises(chirp, 80000, 100000, 1.0), 500 * (1 - std::pow(500.0, -0.2)) / std::log(500.0) * 5,
                1.0);  // cycles in the last second
    const auto grating = force("grating");
    EXPECT_NEAR(rises(grating, 0, grating.size(), 1.0), 20, 1);  // 40 mm/s over 2 mm
}

TEST(Stimulus, WrongNamesAndValuesAreRefusedWithASuggestion) {
    const auto error_text = [](const std::string& text, std::vector<std::string> settings = {}, double rate = 1e3) {
        const auto overrides = test::parse_settings(settings);
        const auto made = make_stimulus(text, overrides, rate, 0);
        return made ? std::string("accepted") : made.error().text();
    };
    EXPECT_EQ(error_text("pres"), "unknown stimulus 'pres'; did you mean 'press'?");
    EXPECT_TRUE(error_text("vibration").starts_with("unknown stimulus 'vibration'; there are press, ")) << error_text("vibration");
    EXPECT_EQ(error_text("press", {"press.F_mx=2N"}),
              "press: unknown parameter 'F_mx'; did you mean 'F_max'? (it has F_min, F_max, t_rest, t_up, t_hold, t_down, t_post)");
    EXPECT_EQ(error_text("press", {"press.F_max=2s"}), "press.F_max: '2s' is a time; expected a value in N, such as '2 N'");
    EXPECT_EQ(error_text("press", {"press.t_up=-1s"}), "press: t_up = -1 s is outside [0, 100000]");
    EXPECT_EQ(error_text("sine", {"sine.duration=0"}), "sine: 0 s at 1000 Hz is less than one sample");
}

}  // namespace
}  // namespace corpuscle
