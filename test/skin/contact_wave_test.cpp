// The contact wave against its closed form, for single sites and afferents whose distance is known.

#include "skin/wave/contact_wave.hpp"

#include <cmath>
#include <numbers>

#include "model/catalog.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

constexpr double T = 1e-3;  // sampling period, s
constexpr std::size_t sites = 12;

/// A row of sites, each in the centre of a wave cell, with one afferent at each.
std::shared_ptr<const Innervation> row_of_cells(const WaveParams& wave) {
    SkinPlan plan{"row", "", *grid_sites(1, sites, wave_cell_side), {}, 7};
    SkinClass c{"fa2", *plan_afferent("fa2")};
    c.per_site = 1, c.wave = wave;
    plan.classes.push_back(std::move(c));
    auto skin = innervate(std::move(plan));
    EXPECT_TRUE(skin) << skin.error().text();
    return *skin;
}

/// The wave on every afferent, [afferent][step], for force[site * steps + step], computed in blocks of `block` steps.
std::vector<std::vector<double>> waves_of(const Innervation& skin, const std::vector<double>& force, std::size_t block = 32) {
    const std::size_t steps = force.size() / sites;
    ThreadPool pool(1);
    auto wave = *ContactWave::make(skin, 0, 0, sites, T, *instruction_set());
    std::vector<std::uint32_t> touched;
    for (std::uint32_t s = 0; s < sites; ++s)
        if (std::any_of(&force[s * steps], &force[s * steps] + steps, [](double f) { return f != 0; })) touched.push_back(s);
    std::vector<std::vector<double>> out(sites, std::vector<double>(steps));
    for (std::size_t at = 0; at < steps; at += block) {
        const auto count = std::min(block, steps - at);
        wave->compute({force.data(), steps}, touched, at, count, pool);
        for (std::size_t u = 0; u < sites; ++u)
            if (const double* f = wave->force_on(u)) std::copy_n(f, count, out[u].begin() + static_cast<std::ptrdiff_t>(at));
    }
    return out;
}

/// The amplitude at frequency f of the samples [from, from + count), a whole number of periods.
double amplitude(const std::vector<double>& x, std::size_t from, std::size_t count, double f) {
    double re = 0, im = 0;
    for (std::size_t k = from; k < from + count; ++k) {
        const double phase = 2 * std::numbers::pi * f * static_cast<double>(k) * T;
        re += x[k] * std::cos(phase), im += x[k] * std::sin(phase);
    }
    return 2 * std::hypot(re, im) / static_cast<double>(count);
}

TEST(ContactWave, AStepOfForceArrivesAfterDistanceOverSpeedWithTheWeightOfItsDistance) {
    const WaveParams wave{.speed = 8, .decay = 30e-3, .radius = 4e-3, .gain = 0.2, .corner = 25};
    constexpr std::size_t steps = 120, from = 10;
    std::vector<double> force(sites * steps);
    std::fill_n(force.begin() + from, steps - from, 3.0);  // 3 N at the first site
    const auto felt = waves_of(*row_of_cells(wave), force);
    const double d = std::exp(-2 * std::numbers::pi * wave.corner * T);
    for (std::size_t u = 0; u < sites; ++u) {
        const double r = static_cast<double>(u) * wave_cell_side, delay = r / wave.speed / T, fraction = delay - std::floor(delay);
        const double weight = wave.gain * std::exp(-r / wave.decay) / std::sqrt(1 + r / wave.radius);
        // The high-pass turns the step into 3 N (1 + d)/2 d^k, k samples after it.
        const auto change = [&](double k) { return k < from ? 0 : 3 * 0.5 * (1 + d) * std::pow(d, k - from); };
        for (std::size_t t = 0; t < steps; ++t) {
            const double k = static_cast<double>(t) - std::floor(delay);
            ASSERT_NEAR(felt[u][t], weight * ((1 - fraction) * change(k) + fraction * change(k - 1)), 1e-12) << u << ' ' << t;
        }
    }
}

TEST(ContactWave, AVibrationAboveTheCornerArrivesWithItsAmplitudeAndAddsUpOverSites) {
    const WaveParams wave{.speed = 10, .decay = 50e-3, .radius = 5e-3, .gain = 1, .corner = 0.5};
    constexpr std::size_t steps = 3000;
    constexpr double f = 50;
    std::vector<double> force(sites * steps);
    for (std::size_t k = 0; k < steps; ++k)
        for (const std::size_t s : {0, 4}) force[s * steps + k] = 1 + std::sin(2 * std::numbers::pi * f * static_cast<double>(k) * T);
    const auto felt = waves_of(*row_of_cells(wave), force);
    const auto weight = [&](double r) { return std::exp(-r / wave.decay) / std::sqrt(1 + r / wave.radius); };
    // At 50 Hz the wavelength is 200 mm. The paths of the two waves differ by 20 mm, that is, by 1/10 of it; both delays are whole samples.
    const double a = weight(40e-3), b = weight(20e-3), phase = 2 * std::numbers::pi / 10;
    EXPECT_NEAR(amplitude(felt[8], 1000, 2000, f), std::hypot(a + b * std::cos(phase), b * std::sin(phase)), 2e-4);
}

TEST(ContactWave, AHeldForceSendsNothingAfterItsOnsetAndAReleaseSendsTheOppositeOfAPress) {
    const WaveParams wave{.speed = 8, .gain = 0.5};
    constexpr std::size_t steps = 2000;
    std::vector<double> force(sites * steps);
    std::fill_n(force.begin() + 100, 900, 2.0);
    const auto felt = waves_of(*row_of_cells(wave), force);
    for (std::size_t u = 0; u < sites; ++u)
        for (std::size_t t = 0; t < 900; ++t) {
            ASSERT_NEAR(felt[u][1000 + t], -felt[u][100 + t], 1e-11);
            ASSERT_TRUE(t <= 400 || felt[u][100 + t] == 0) << u << ' ' << t;
        }
}

TEST(ContactWave, IsTheSameForAllBlockLengths) {
    EXPECT_TRUE(rc::check([] {
        const WaveParams wave{.speed = *rc::gen::element(0.6, 3.0, 8.0, 150.0), .decay = *rc::gen::element(1e-3, 40e-3, 0.2), .gain = 0.5};
        const auto skin = row_of_cells(wave);
        constexpr std::size_t steps = 700;
        std::vector<double> force(sites * steps);
        for (int presses = *rc::gen::inRange(1, 6); presses > 0; --presses) {
            const auto site = *rc::gen::inRange<std::size_t>(0, sites), from = *rc::gen::inRange<std::size_t>(0, steps);
            const auto to = std::min(steps, from + *rc::gen::inRange<std::size_t>(1, 100));
            for (std::size_t t = from; t < to; ++t) force[site * steps + t] = *rc::gen::element(0.0, 0.5, 2.0);
        }
        RC_ASSERT(waves_of(*skin, force, *rc::gen::element<std::size_t>(1, 3, 7, 31)) == waves_of(*skin, force));
    }));
}

TEST(ContactWave, AWaveTooSlowForTheRateIsRefused) {
    const auto skin = row_of_cells({.speed = 0.5, .decay = 0.2});
    EXPECT_TRUE(ContactWave::make(*skin, 0, 0, sites, T, *instruction_set()));
    const auto made = ContactWave::make(*skin, 0, 0, sites, 1e-9, *instruction_set());
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("raise wave_speed"), std::string::npos) << made.error().message;
}

}  // namespace
}  // namespace corpuscle
