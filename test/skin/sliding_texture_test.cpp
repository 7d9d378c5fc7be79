// The vibration of a sliding texture: the lines of a grating and the band of a rough surface, against their closed forms.

#include <cmath>
#include <numbers>
#include <numeric>

#include "skin/contact/contact.hpp"
#include "skin/contact/sliding_texture.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

constexpr double rate = 1000;  // Hz

/// A patch of skin with sites every 2 mm.
Sites patch() {
    auto sites = *grid_sites(9, 9, 2e-3);
    sites.area = 4e-6;
    return sites;
}

struct Slide {
    std::string indenter;
    std::vector<std::string> settings;
    std::uint64_t seed = 1;
};

std::unique_ptr<Contact> contact_of(const Slide& slide, const Sites& sites) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : slide.settings) overrides.push_back(*parse_override("contact." + text));
    auto made = make_contact(slide.indenter, overrides, sites, *make_clock(rate), slide.seed);
    EXPECT_TRUE(made) << made.error().text();
    return std::move(made->result);
}

/// The force at each site under 1 N in the samples [from, from + count), [site][sample], N.
std::vector<std::vector<double>> forces(const Slide& slide, std::int64_t from, std::size_t count) {
    const auto sites = patch();
    const auto contact = contact_of(slide, sites);
    const std::vector<double> force(count, 1.0);
    const auto pressed = contact->press(force, from);
    EXPECT_TRUE(pressed) << pressed.error().text();
    std::vector<std::vector<double>> out(sites.size(), std::vector<double>(count));
    for (const auto s : pressed->touched) std::copy_n(pressed->data + s * pressed->stride, count, out[s].begin());
    return out;
}

std::vector<double> total(const std::vector<std::vector<double>>& forces) {
    std::vector<double> out(forces[0].size());
    for (const auto& f : forces)
        for (std::size_t k = 0; k < out.size(); ++k) out[k] += f[k];
    return out;
}

/// The amplitude at frequency f (Hz); the samples are a whole number of periods.
double amplitude(const std::vector<double>& x, double f) {
    double re = 0, im = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double phase = 2 * std::numbers::pi * f * static_cast<double>(k) / rate;
        re += x[k] * std::cos(phase), im += x[k] * std::sin(phase);
    }
    return 2 * std::hypot(re, im) / static_cast<double>(x.size());
}

double mean(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }

const Slide fine_grating = {"grating", {"radius=6mm", "period=1mm", "ridge=0.5mm", "speed=80mm/s", "vibration=0.04"}};

// A cell of 2 mm has two periods of this grating, so its mean pressure is constant: all that moves is the vibration.
TEST(SlidingTexture, AGratingFinerThanTheSitesVibratesAtSpeedOverPeriodWithHarmonicsOfOneOverH) {
    const auto felt = forces(fine_grating, 500, 1000);
    const auto& middle = felt[40];
    ASSERT_GT(mean(middle), 0);
    for (int h = 1; h <= 6; ++h) EXPECT_NEAR(amplitude(middle, 80 * h), mean(middle) * 0.04 / h, 1e-9) << h;
    for (const double f : {40.0, 79.0, 81.0, 120.0, 499.0}) EXPECT_LT(amplitude(middle, f), 1e-9) << f;
    // Sites are two periods apart, so all vibrate together, around the force on the indenter.
    EXPECT_NEAR(mean(total(felt)), 1, 1e-9);
    EXPECT_NEAR(amplitude(total(felt), 80), 0.04, 1e-9);
}

TEST(SlidingTexture, AMovedGratingVibratesLikeOneThatPassesUnderItsPatch) {
    const Slide moved = {"grating", {"radius=6mm", "period=1mm", "ridge=0.5mm", "x=-90mm", "y=8mm", "x1=120mm", "speed=80mm/s"}};
    const auto felt = total(forces(moved, 1200, 50));  // 6 to 10 mm: on the patch
    EXPECT_NEAR(amplitude(felt, 80), 0.03, 2e-3);
}

TEST(SlidingTexture, FrequenciesThatCannotBeSampledAreLeftOutAndReported) {
    const Slide grating = {"grating", {"radius=6mm", "period=0.2mm", "ridge=0.1mm", "speed=80mm/s"}};  // 400 Hz, then 800 Hz
    const auto felt = forces(grating, 500, 1000);
    EXPECT_NEAR(amplitude(felt[40], 400), 0.03 * mean(felt[40]), 1e-9);
    EXPECT_LT(amplitude(felt[40], 200), 1e-9);  // 800 Hz would appear at 200 Hz
    const auto sites = patch();
    const auto notes = contact_of(grating, sites)->notes();
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const auto& n) { return n.find("the sampling rate of 1 kHz") != n.npos; }));
}

TEST(SlidingTexture, ARestingSurfaceDoesNotVibrate) {
    Slide slide = fine_grating;
    slide.settings.push_back("t_start=0.3s");
    for (const auto& f : forces(slide, 0, 300))
        for (const double x : f) EXPECT_EQ(x, f[0]);
    const Slide moved = {"sphere", {"radius=20mm", "roughness=0.1", "x=4mm", "y=8mm", "x1=12mm", "t_move=0.1s"}};
    for (const auto& f : forces(moved, 101, 100))
        for (const double x : f) EXPECT_EQ(x, f[0]);
}

const Slide cloth = {"sphere", {"radius=30mm", "roughness=0.05", "grain=1mm", "speed=80mm/s"}};

TEST(SlidingTexture, ARoughSurfaceVibratesAroundSpeedOverGrainWithItsRootMeanSquare) {
    const auto felt = forces(cloth, 500, 20000)[40];
    const double steady = mean(felt);
    double square = 0, weighted = 0, power = 0;
    for (const double f : felt) square += (f / steady - 1) * (f / steady - 1) / static_cast<double>(felt.size());
    EXPECT_NEAR(std::sqrt(square), 0.05, 0.005);
    for (int f = 1; f < 500; ++f) {
        const double a = amplitude(felt, f);
        weighted += a * a * std::log(f), power += a * a;
    }
    EXPECT_NEAR(std::exp(weighted / power), 80, 20);
    EXPECT_NEAR(mean(total(forces(cloth, 500, 20000))), 1, 0.002);
}

TEST(SlidingTexture, SpeedScalesTheFrequenciesOfARoughSurface) {
    Slide fast = cloth;
    fast.settings.back() = "speed=160mm/s";
    const auto slow_felt = forces(cloth, 500, 200), fast_felt = forces(fast, 250, 100);
    for (std::size_t s = 0; s < slow_felt.size(); ++s)
        for (std::size_t k = 0; k < 100; ++k) ASSERT_NEAR(fast_felt[s][k], slow_felt[s][2 * k], 1e-9);
}

TEST(SlidingTexture, DependsOnTheSeedAndOnNothingThatHappenedBefore) {
    Slide other = cloth;
    other.seed = 2;
    EXPECT_EQ(forces(cloth, 500, 50), forces(cloth, 500, 50));
    EXPECT_NE(forces(cloth, 500, 50), forces(other, 500, 50));
    const auto undivided = forces(cloth, 400, 300);
    const auto sites = patch();
    const auto contact = contact_of(cloth, sites);
    const std::vector<double> force(300, 1.0);
    for (const auto& [from, count] : {std::pair(650, 50), {600, 50}, {400, 7}, {407, 193}}) {  // out of order
        const auto pressed = *contact->press({force.data(), static_cast<std::size_t>(count)}, from);
        for (const auto s : pressed.touched)
            for (int k = 0; k < count; ++k)
                ASSERT_EQ(pressed.data[s * pressed.stride + static_cast<std::size_t>(k)],
                          undivided[s][static_cast<std::size_t>(from - 400 + k)]);
    }
}

/// The force at the middle site under 1 N, at positions along y = 8 mm.
std::vector<double> force_at_middle(const Slide& slide, const std::vector<double>& x) {
    const auto sites = patch();
    const auto contact = contact_of(slide, sites);
    const std::vector<double> force(x.size(), 1.0), y(x.size(), 8e-3);
    const auto pressed = contact->press({.force = force, .x = x, .y = y});
    EXPECT_TRUE(pressed) << pressed.error().text();
    return {pressed->data + 40 * pressed->stride, pressed->data + 40 * pressed->stride + x.size()};
}

TEST(SlidingTexture, ASurfaceThatPassesUnderAGivenPositionVibratesAsUnderARestingContact) {
    auto felt = force_at_middle(fine_grating, std::vector<double>(1500, 8e-3));
    felt.erase(felt.begin(), felt.begin() + 500);
    for (int h = 1; h <= 6; ++h) EXPECT_NEAR(amplitude(felt, 80 * h), mean(felt) * 0.04 / h, 1e-9) << h;
}

TEST(SlidingTexture, ARoughSurfaceVibratesWhileGivenPositionsMoveAndFadesAtRest) {
    std::vector<double> x;  // back and forth over 4 mm at 40 mm/s, then at rest
    for (int k = 0; k < 2000; ++k) x.push_back(8e-3 + 2e-3 * std::abs(k % 100 - 50) / 50 * 2 - 2e-3);
    x.resize(2500, x.back());
    const auto rough = force_at_middle({"flat", {"radius=8mm", "roughness=0.1", "grain=1mm"}}, x);
    const auto smooth = force_at_middle({"flat", {"radius=8mm"}}, x);
    double squares = 0;
    for (std::size_t k = 100; k < 2000; ++k) squares += std::pow(rough[k] / smooth[k] - 1, 2) / 1900;
    EXPECT_NEAR(std::sqrt(squares), 0.1, 0.04);
    for (std::size_t k = 2300; k < 2500; ++k) EXPECT_EQ(rough[k], smooth[k]);
    EXPECT_EQ(rough[0], smooth[0]) << "without movement there is no vibration";
}

}  // namespace
}  // namespace corpuscle
