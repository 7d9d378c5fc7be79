// The texture task on made-up slides whose surfaces are known.

#include "reproduction/texture/texture_task.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/random.hpp"
#include "reproduction/texture/slide_spectrum.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

constexpr std::size_t taxels = 4;

/// A slide of `seconds` over a surface that shakes the taxels with this frequency (Hz); `level` and `depth` in counts.
Slide make_slide(std::size_t surface, std::size_t grip, std::size_t speed, double seconds, double frequency, double level, double depth) {
    Slide out{"made", surface, grip, speed};
    const auto values = [&](double rate) {
        std::vector<std::vector<double>> of_taxels(taxels);
        for (std::size_t c = 0; c < taxels; ++c)
            for (int k = 0; k < seconds * rate; ++k)
                of_taxels[c].push_back(level + depth * std::sin(6.283185307 * frequency * k / rate + static_cast<double>(c)));
        return of_taxels;
    };
    out.counts = {values(slide_frame_rate), values(slide_force_rate)};
    return out;
}

/// Two surfaces, each recorded with two grips and two speeds. Only the frequency tells the surfaces apart.
std::vector<Slide> make_slides() {
    std::vector<Slide> out;
    for (const std::size_t surface : {0, 1})
        for (const std::size_t grip : {0, 1})
            for (const std::size_t speed : {0, 1})
                out.push_back(make_slide(surface, grip, speed, speed ? 6 : 20, surface ? 3 : 0.5, grip ? 200 : 120, 50));
    return out;
}

double mean_of(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size()); }

/// True if a read-out that tests `b` may learn `a`.
bool may_learn(const SlideTrial& a, const SlideTrial& b, SlideTest test) {
    if (test == SlideTest::other_speed) return a.speed != b.speed;
    if (test == SlideTest::other_grip) return a.grip != b.grip;
    return a.recording != b.recording || std::max(a.from, b.from) - std::min(a.to, b.to) >= 2;  // at least a window lies between them
}

TEST(TextureTask, TestsEachTrialOnceAndLearnsNoneOfTheTestedPart) {
    const auto trials = slide_trials(make_slides(), 2);
    for (const auto test : {SlideTest::other_half, SlideTest::other_speed, SlideTest::other_grip}) {
        std::multiset<std::size_t> tested;
        for (const auto& split : slide_splits(trials, test)) {
            EXPECT_FALSE(split.learned.empty());
            tested.insert(split.tested.begin(), split.tested.end());
            for (const auto k : split.tested)
                for (const auto l : split.learned) EXPECT_TRUE(may_learn(trials[l], trials[k], test)) << l << ", " << k;
        }
        std::size_t expected = 0;
        for (const auto& t : trials) expected += test != SlideTest::other_half || t.windows >= 4;
        EXPECT_EQ(tested.size(), expected);
        EXPECT_EQ(std::set<std::size_t>(tested.begin(), tested.end()).size(), expected);
    }
}

TEST(TextureTask, FastAfferentsTellFrequenciesApartAndMeansOfReadingsDoNot) {
    const auto slides = make_slides();
    const auto forces = slide_forces(slides, SlidePart::change_shape, 0);
    TextureTask task(slide_trials(slides, 2));
    task.add("mean", mean_readings(task.trials(), forces)), task.add("change", mean_changes(task.trials(), forces));
    task.add("fa1", spike_counts(task.trials(), value_or_throw(simulate_slides("fa1", forces))));
    for (const auto test : {SlideTest::other_half, SlideTest::other_speed, SlideTest::other_grip}) {
        EXPECT_EQ(task.accuracy({"fa1"}, test, taxels).mean, 1);
        EXPECT_EQ(task.accuracy({"change"}, test, 1).mean, 1);
        EXPECT_LT(task.accuracy({"mean"}, test, taxels).mean, 0.8);
    }
}

TEST(TextureTask, IsAtChanceIfFeaturesSayNothing) {
    const auto slides = make_slides();
    TextureTask task(slide_trials(slides, 0.25));
    TaxelFeature noise;
    for (std::uint32_t k = 0; k < task.trials().size(); ++k) {
        noise.emplace_back();
        for (std::uint32_t c = 0; c < taxels; ++c) noise.back().push_back(normal(1, k, 1, c));
    }
    task.add("noise", noise);
    for (const auto test : {SlideTest::other_half, SlideTest::other_speed, SlideTest::other_grip}) {
        const auto a = task.accuracy({"noise"}, test, taxels);
        EXPECT_NEAR(a.mean, 0.5, 0.1);
        EXPECT_LT(a.low, 0.5);
    }
}

TEST(TextureTask, ForcesWithoutLevelHaveOneMeanAndThoseWithoutDepthOneDeviation) {
    const std::vector<Slide> slides = {make_slide(0, 0, 0, 20, 0.5, 120, 10), make_slide(1, 0, 0, 20, 0.5, 300, 20)};
    const auto ratio_of_changes = [&](SlidePart part) {
        const auto forces = slide_forces(slides, part, 0);
        for (const auto& f : forces) EXPECT_NEAR(mean_of(f.frames[1]), slide_level, 1e-9);
        const auto trials = slide_trials(slides, 8);
        const auto changes = mean_changes(trials, forces);
        return changes[trials.size() / 2][1] / changes[0][1];  // the first window of each slide
    };
    EXPECT_NEAR(ratio_of_changes(SlidePart::change), 2, 1e-6);
    EXPECT_NEAR(ratio_of_changes(SlidePart::change_shape), 1, 1e-6);
    EXPECT_NEAR(mean_of(slide_forces(slides, SlidePart::all, 10e-3)[1].frames[0]), 3.0, 0.05);
}

TEST(TextureTask, ChoicesOfTaxelsAreDistinctAndRepeatable) {
    EXPECT_EQ(taxel_choices(1, 16).size(), 16u);
    EXPECT_EQ(taxel_choices(16, 16).size(), 1u);
    const auto choices = taxel_choices(4, 16);
    EXPECT_EQ(choices, taxel_choices(4, 16));
    EXPECT_GT((std::set<std::vector<std::size_t>>(choices.begin(), choices.end()).size()), 15u);
    for (const auto& c : choices) EXPECT_EQ((std::set<std::size_t>(c.begin(), c.end()).size()), 4u);
}

TEST(TextureTask, TheStrongestFrequencyIsThatOfTheSurface) {
    const auto slide = make_slide(0, 0, 0, 30, 1.25, 120, 5);
    EXPECT_NEAR(strongest_frequency(slide.counts, 0.6, 10), 1.25, 1e-9);
    EXPECT_NEAR(strongest_frequency(slide.counts, 0.1, 10), 1.25, 1e-9);
}

TEST(TextureTask, ChipsFireAsOftenAsOneChipAtATime) {
    const std::vector<Slide> slides = {make_slide(0, 0, 0, 1.5, 3, 200, 100)};
    const auto forces = slide_forces(slides, SlidePart::all, 10e-3);
    const auto together = value_or_throw(simulate_slides_with_chips("fa1-circuit", forces, 1, [](double) { return true; }));
    const auto alone = value_or_throw(simulate_slides("fa1-circuit", forces));
    ASSERT_EQ(together.front().size(), taxels);
    for (std::size_t c = 0; c < taxels; ++c) {
        const auto& train = alone.front()[c];
        const auto count = static_cast<std::size_t>(std::lower_bound(train.begin(), train.end(), 1 - 1e-3) - train.begin());
        EXPECT_GT(count, 0u);
        EXPECT_EQ(together.front()[c].size(), count) << c;
    }
}

TEST(TextureTask, AMissingFileIsAnErrorThatNamesIt) {
    Slide slide{"nothing"};
    const auto read = read_slide(slide, "/nowhere");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().text().find("/nowhere/nothing.csv"), std::string::npos) << read.error().text();
}

TEST(TextureTask, RecordingsHaveSixteenTaxelsInCounts) {
    const auto folder = test::shared_file_path("fabric_slide_cpm");
    CORPUSCLE_NEEDS(folder);
    Slide slide{"Linen_F120_V20mmps_0"};
    const auto read = read_slide(slide, folder);
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(slide.counts.frames.size(), 16u);
    EXPECT_EQ(slide.counts.frames[0].size(), 1058u);
    EXPECT_EQ(slide.counts.frames[0][0], 55);
    EXPECT_EQ(slide.counts.frames[15][1], 108);
    EXPECT_NEAR(static_cast<double>(slide.counts.smooth[0].size()) / slide_force_rate, 1057 / slide_frame_rate, 0.01);
}

}  // namespace
}  // namespace corpuscle
