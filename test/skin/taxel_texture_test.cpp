// The vibration of a texture that slides over taxels, against its closed form.

#include "skin/taxel/taxel_texture.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "skin/taxel/taxel_frames.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::value_or_throw;

constexpr double frame_rate = 2000;  // Hz

Sites taxel_patch() {
    auto sites = *grid_sites(9, 9, 2e-3);
    sites.area = 4e-6;
    return sites;
}

std::vector<ParameterOverride> texture_overrides(const std::vector<std::string>& settings) {
    std::vector<ParameterOverride> out;
    for (const auto& text : settings) out.push_back(*parse_override("contact." + text));
    return out;
}

std::string texture_error(const std::vector<std::string>& settings) {
    const auto sites = taxel_patch();
    const auto made = make_taxel_texture(texture_overrides(settings), sites, frame_rate, 1);
    return made ? "none" : made.error().message;
}

/// The forces of all sites under one taxel of 2 N that covers 8 mm x 8 mm, for this number of frames: [frame][site], N.
std::vector<std::vector<double>> slide_over_taxel(const Sites& sites, const std::vector<std::string>& settings, std::size_t frames) {
    const TemporaryFolder folder;
    const auto layout = value_or_throw(read_taxel_layout(folder.write("t.csv", "name,x_mm,y_mm,width_mm,height_mm\na,8,8,8,8\n")));
    TaxelFrames taxels(layout, value_or_throw(map_taxels(layout, sites)), false);
    taxels.set_texture(value_or_throw(make_taxel_texture(texture_overrides(settings), sites, frame_rate, 1)).result);
    std::vector<std::vector<double>> out(frames, std::vector<double>(sites.size()));
    const double force = 2;
    for (auto& at : out) EXPECT_NEAR(taxels.spread(&force, at.data(), nullptr, nullptr), 2, 1e-12);
    return out;
}

double sum_of_sites(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

TEST(TaxelTexture, AGratingVibratesAtSpeedOverPeriodWhileItSlides) {
    const auto sites = taxel_patch();
    // Sites are two periods apart, so all vibrate alike: 1 mm at 80 mm/s is 80 Hz, 25 samples a period.
    const auto at =
        slide_over_taxel(sites, {"period=1mm", "ridge=0.5mm", "vibration=0.04", "speed=80mm/s", "t_start=0.5s", "t_move=1s"}, 4000);
    for (std::size_t k = 0; k < at.size(); ++k)
        if (k <= 1000 || k >= 3000) {
            EXPECT_EQ(sum_of_sites(at[k]), sum_of_sites(at[0])) << k << ": at rest";
        }
    EXPECT_NEAR(sum_of_sites(at[0]), 2, 1e-12);
    for (int h = 1; h <= 3; ++h) {
        double re = 0, im = 0;
        for (std::size_t k = 1500; k < 2500; ++k) {
            const double phase = 2 * std::numbers::pi * 80 * h * static_cast<double>(k) / frame_rate;
            re += sum_of_sites(at[k]) * std::cos(phase), im += sum_of_sites(at[k]) * std::sin(phase);
        }
        EXPECT_NEAR(2 * std::hypot(re, im) / 1000, 2 * 0.04 / h, 1e-9) << h;
    }
}

TEST(TaxelTexture, ARoughSurfaceHasItsRootMeanSquareAtEverySiteAndNoForceWhereThereIsNone) {
    const auto sites = taxel_patch();
    const auto at = slide_over_taxel(sites, {"roughness=0.05", "grain=1mm", "speed=80mm/s", "angle=90"}, 20'000),
               still = slide_over_taxel(sites, {}, 1);
    double squares = 0;
    int touched = 0;
    for (std::size_t s = 0; s < sites.size(); ++s) {
        if (still[0][s] == 0) {
            for (const auto& frame : at) ASSERT_EQ(frame[s], 0);
            continue;
        }
        ++touched;
        for (std::size_t k = 100; k < at.size(); ++k) squares += std::pow(at[k][s] / still[0][s] - 1, 2);
    }
    EXPECT_NEAR(std::sqrt(squares / touched / 19'900), 0.05, 0.005);
    EXPECT_EQ(slide_over_taxel(sites, {"roughness=0.05", "grain=1mm", "speed=80mm/s", "angle=90"}, 50),
              std::vector(at.begin(), at.begin() + 50));
}

TEST(TaxelTexture, ErrorsNameTheParameterAndARemedy) {
    EXPECT_EQ(texture_error({}), "none");
    EXPECT_EQ(texture_error({"roughness=0.05"}),
              "contact: the speed of the texture is missing; add it, such as --set contact.speed=20mm/s");
    EXPECT_NE(texture_error({"speed=20mm/s"}).find("add --set contact.roughness=0.03, or --set contact.period=2mm"), std::string::npos);
    EXPECT_EQ(texture_error({"speed=20mm/s", "roughness=0.03"}), "none");
    EXPECT_EQ(texture_error({"speed=20mm/s", "period=2mm"}), "none");
    EXPECT_NE(texture_error({"speed=20mm/s", "roughness=0.03", "period=2mm"}).find("remove one of them"), std::string::npos);
    EXPECT_NE(texture_error({"speed=20mm/s", "radius=2mm"}).find("contact.radius: taxels have no indenter"), std::string::npos);
    EXPECT_NE(texture_error({"speed=20mm/s", "period=2mm", "ridge=3mm"}).find("must not be wider than period"), std::string::npos);
}

TEST(TaxelTexture, SaysThatItIsComputedAndWhatTheFramesCannotContain) {
    const auto sites = taxel_patch();
    const auto notes = [&](double per_second) {
        return value_or_throw(
                   make_taxel_texture(texture_overrides({"roughness=0.05", "grain=0.5mm", "speed=100mm/s"}), sites, per_second, 1))
            .result->notes();
    };
    ASSERT_EQ(notes(2000).size(), 1U);
    EXPECT_NE(notes(2000)[0].find("the vibration around 200 Hz is computed, not measured"), std::string::npos);
    ASSERT_EQ(notes(36).size(), 2U);
    EXPECT_NE(notes(36)[1].find("left out; for a recording, --resample 2kHz --interpolation smooth"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
