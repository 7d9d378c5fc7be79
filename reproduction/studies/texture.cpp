// A texture task. A fingertip of 16 taxels slid over three fabrics and two gratings; its recordings have 35.6 frames a second. Afferents on
// the taxels respond, and a linear read-out tells the surfaces apart from their numbers of spikes, or from the readings themselves.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/texture/accuracy_plot.hpp"
#include "reproduction/texture/chip_comparison.hpp"
#include "reproduction/texture/slide_spectrum.hpp"

namespace corpuscle::studies::texture {

constexpr const char* folder = "fabric_slide_cpm";

using Readers = std::vector<TextureReader>;
const Readers readers = {{"SA-I", {"sa1"}},
                         {"FA-I", {"fa1"}},
                         {"SA-I calibrated to nerves", {"sa1-nerve"}},
                         {"FA-I calibrated to nerves", {"fa1-nerve"}},
                         {"means of readings", {"mean"}},
                         {"changes of readings", {"change"}}};
const Readers pairs_of_readers = {{"SA-I and FA-I", {"sa1", "fa1"}},
                                  {"SA-I and FA-I calibrated to nerves", {"sa1-nerve", "fa1-nerve"}},
                                  {"means and changes of readings", {"mean", "change"}}};
constexpr std::pair<SlideTest, const char*> tests[] = {
    {SlideTest::other_half, "other half"}, {SlideTest::other_speed, "other speed"}, {SlideTest::other_grip, "other grip"}};
constexpr std::pair<SlidePart, const char*> parts[] = {{SlidePart::all, "as recorded"},
                                                       {SlidePart::change, "without the mean load"},
                                                       {SlidePart::change_shape, "without mean load and depth"}};

/// The tests that the surfaces allow: there is only one recording of each grating.
std::span<const std::pair<SlideTest, const char*>> tests_of(const TextureSurfaces& s) {
    return std::span(tests).first(s.slides.size() > 2 ? std::size(tests) : 1);
}

/// Adds a claim that an accuracy is above chance: the lower end of its interval is.
void claim_above_chance(StudyResult& out, const std::string& label, const Accuracy& a, double chance, std::string reason) {
    out.claim(label + ": lower end of the interval of the accuracy", 100 * a.low, "%")
        .allow_min(100 * chance, "check: above chance")
        .explain_if_needed(std::move(reason));
}

/// Where an accuracy lies between chance (0) and certainty (1).
double above_chance(const Accuracy& a, double chance) { return (a.mean - chance) / (1 - chance); }

void claim_fabrics(StudyResult& out, const TextureSurfaces& fabrics) {
    const auto accuracy = [&](const char* feature, SlideTest test, SlidePart part = SlidePart::all, std::size_t taxels = texture_taxels) {
        return fabrics.tasks.at(part).accuracy({feature}, test, taxels);
    };
    const auto above = [&](const char* label, const char* feature, SlideTest test, const char* reason) {
        claim_above_chance(out, label, accuracy(feature, test), fabrics.chance, reason);
    };
    const auto sa1 = accuracy("sa1", SlideTest::other_half), mean = accuracy("mean", SlideTest::other_half),
               one = accuracy("sa1", SlideTest::other_half, SlidePart::all, 1),
               without_load = accuracy("sa1", SlideTest::other_half, SlidePart::change);
    above("fabrics, other half, SA-I", "sa1", SlideTest::other_half, "not known");
    above("fabrics, other speed, SA-I", "sa1", SlideTest::other_speed, "not known");
    out.claim("fabrics, other half: accuracy of SA-I less that of means of readings", 100 * (sa1.mean - mean.mean), "%")
        .allow_min(-15, "check: the spikes keep the difference between the readings");
    out.claim("fabrics, other half, SA-I: accuracy with 16 taxels less that with one", 100 * (sa1.mean - one.mean), "%")
        .allow_min(20, "check: more afferents tell more");
    const char* load =
        "the read-out uses the pattern of mean loads on the taxels, and a firmer grip changes it more than another fabric does";
    above("fabrics, other grip, SA-I", "sa1", SlideTest::other_grip, load);
    above("fabrics, other grip, means of readings", "mean", SlideTest::other_grip, load);
    above("fabrics, other half, FA-I", "fa1", SlideTest::other_half,
          "FA-I are silent: the load changes too slowly, and 35.6 frames a second contain no vibration of a cloth");
    out.claim("fabrics, other half, SA-I: advantage over chance without the mean load, over that as recorded",
              above_chance(without_load, fabrics.chance) / above_chance(sa1, fabrics.chance))
        .allow_min(0.5, "check: the advantage does not come from the mean load")
        .explain_if_needed("it does come from the mean load of each recording");
}

void claim_gratings(StudyResult& out, const TextureSurfaces& gratings) {
    const char* gaps = "if the gaps of the grating are as wide as its ridges, which is not stated";
    out.claim("grating of 2 mm: strongest frequency above 0.6 Hz", strongest_frequency(gratings.slides[0].counts, 0.6, 10), "Hz")
        .derived_as(1.25, fmt::format("5 mm/s over 4 mm, {}", gaps));
    out.claim("grating of 10 mm: strongest frequency", strongest_frequency(gratings.slides[1].counts, 0.1, 10), "Hz")
        .derived_as(0.25, fmt::format("5 mm/s over 20 mm, {}", gaps));
    out.claim("grating of 2 mm: strongest frequency", strongest_frequency(gratings.slides[0].counts, 0.1, 10), "Hz")
        .explain("not that of the grating; the cause is not known");
}

/// Claims about the course of the load alone. Equal depths also scale the noise of the sensor, so the slow part is read by itself, too.
void claim_change_shape(StudyResult& out, const TextureSurfaces& gratings) {
    const auto above = [&](const char* name, const char* feature, const char* reason) {
        claim_above_chance(out, fmt::format("{} without mean load and depth, {}", gratings.name, name),
                           gratings.tasks.at(SlidePart::change_shape).accuracy({feature}, SlideTest::other_half, texture_taxels),
                           gratings.chance, reason);
    };
    above("changes of readings", "change", "not known");
    above("FA-I calibrated to nerves", "fa1-nerve", "not known");
    above("FA-I", "fa1", "FA-I are nearly silent: the load changes too slowly");
    above("SA-I", "sa1", "SA-I follow the load: their count in a window depends on its mean, not on its frequency");
}

/// Lists and plots the accuracies with one part of the readings.
void report_part(StudyResult& out, const TextureSurfaces& surfaces, SlidePart part, const char* part_name) {
    const auto& task = surfaces.tasks.at(part);
    auto listed = readers;
    if (part == SlidePart::all) listed.insert(listed.end(), pairs_of_readers.begin(), pairs_of_readers.end());
    for (const auto& [test, test_name] : tests_of(surfaces)) {
        const auto label = fmt::format("{} {}, {}", surfaces.name, part_name, test_name);
        for (const auto& r : listed) {
            const auto a = task.accuracy(r.features, test, texture_taxels);
            out.claim(fmt::format("{}, {}: accuracy", label, r.name), 100 * a.mean, "%").explain(interval_text(a));
        }
        if (part == SlidePart::all || test != SlideTest::other_grip)
            plot_over_taxels(out, label, task, test, readers, texture_taxels, surfaces.chance);
    }
}

/// Counts the read-outs that tell fabrics apart, not recordings, without the mean load.
void count_without_load(StudyResult& out, const TextureSurfaces& fabrics) {
    double above = 0, all = 0;
    for (const auto part : {SlidePart::change, SlidePart::change_shape})
        for (const auto test : {SlideTest::other_speed, SlideTest::other_grip})
            for (const auto& r : readers) {
                all += 1;
                above += fabrics.tasks.at(part).accuracy(r.features, test, texture_taxels).low > fabrics.chance;
            }
    out.claim("fabrics without the mean load, other speed or grip: read-outs whose interval is above chance", above)
        .explain(fmt::format("of {:g}; if none tells anything, one in forty is expected", all));
}

/// The accuracies of SA-I and FA-I over the scale of the readings.
Result<void> sweep_scale(StudyResult& out, const TextureSurfaces& surfaces) {
    auto& plot = out.plot(fmt::format("{} as recorded, other half: the scale of the readings", surfaces.name), "force of a count (mN)",
                          "accuracy (%)", true);
    BarCurve sa1, fa1;
    double lowest = 1, fa1_scale = Claim::none;
    for (const double newtons : {2.5e-3, 5e-3, 10e-3, 20e-3, 40e-3, 80e-3, 160e-3}) {
        const auto task = TRY(make_texture_task(surfaces.slides, slide_forces(surfaces.slides, SlidePart::all, newtons)));
        const auto slow = task.accuracy({"sa1"}, SlideTest::other_half, texture_taxels),
                   fast = task.accuracy({"fa1"}, SlideTest::other_half, texture_taxels);
        sa1.add(1e3 * newtons, slow), fa1.add(1e3 * newtons * 1.04, fast);
        if (newtons >= 5e-3) lowest = std::min(lowest, slow.low);
        if (std::isnan(fa1_scale) && fast.low > surfaces.chance) fa1_scale = newtons;
    }
    std::move(sa1).add_to(plot, "SA-I"), std::move(fa1).add_to(plot, "FA-I");
    add_chance(plot, surfaces.chance, 2.5, 160);
    out.claim(fmt::format("{}, SA-I: lowest lower end of the interval, if a count is 5 to 160 mN", surfaces.name), 100 * lowest, "%")
        .allow_min(100 * surfaces.chance, "check: above chance at each scale")
        .explain_if_needed("not known");
    out.claim(fmt::format("{}, FA-I: the smallest force of a count with an accuracy above chance", surfaces.name), fa1_scale, "N")
        .explain(std::isnan(fa1_scale) ? "none up to 160 mN" : "the mean loads are then far beyond the 4 N of the thesis");
    return {};
}

/// The accuracies over the duration of the windows.
Result<void> sweep_windows(StudyResult& out, const TextureSurfaces& fabrics) {
    auto& plot = out.plot("fabrics as recorded, other half: the duration of the windows", "window (s)", "accuracy (%)", true);
    BarCurve sa1, mean;
    for (const double window : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const auto task = TRY(make_texture_task(fabrics.slides, slide_forces(fabrics.slides, SlidePart::all, texture_scale), window));
        sa1.add(window, task.accuracy({"sa1"}, SlideTest::other_half, texture_taxels));
        mean.add(window * 1.04, task.accuracy({"mean"}, SlideTest::other_half, texture_taxels));
    }
    std::move(sa1).add_to(plot, "SA-I"), std::move(mean).add_to(plot, "means of readings");
    add_chance(plot, fabrics.chance, 0.25, 4);
    return {};
}

std::vector<std::string> notes() {
    return {
        "A trial is a window of 2 s. An afferent's feature is its number of spikes in the window; that of a reading is its mean, or the "
        "mean "
        "of its absolute changes from frame to frame. So SA-I and means, and FA-I and changes, have the same number of features. The "
        "read-out is the ridge regression of the study touch. Fewer taxels: the mean of 20 random choices, which are the same for all "
        "read-outs; one taxel: the mean of all.",
        "Tests. Other half: learned from one half of each slide at 20 mm/s (gratings: 5 mm/s) and tested with the other, without the "
        "windows "
        "next to it. Surface and recording are then the same thing: what this test tells apart may be the recordings. Other speed and "
        "other "
        "grip: learned from the recordings with one speed or grip, tested with those of the other, so that no recording is in both.",
        "The interval is Wilson's, with the windows of half a recording taken as one group. It is wide because there are few recordings, "
        "and "
        "for the gratings only four halves.",
        "The recordings cannot show that a fabric is told apart, rather than its session. Each fabric was recorded once with each grip and "
        "speed, all four within about 40 minutes, one fabric after the other (by the timestamps), so that it may have been fastened only "
        "once. SA-I and the means of readings tell the pattern of mean loads apart. It is the same at both speeds, but not in both grips. "
        "Without it SA-I are at chance with the other half, and little above it with the other speed. That suggests the shape under the "
        "fingertip rather than a texture.",
        "The recordings do not contain the weave. 35.6 frames a second carry up to 17.8 Hz: waves from 1.1 mm at 20 mm/s, from 5.6 mm at "
        "100 "
        "mm/s. The changes of readings tell halves of recordings apart, but hardly fabrics at another speed, and not at another grip.",
        "The gratings are within that band, and their period is in the readings. As recorded, the mean loads of the two recordings tell "
        "them "
        "apart. Without mean load and depth only the course of the load is left, and the changes of readings and FA-I calibrated to nerves "
        "still tell the gratings apart, while SA-I do not. Equal depths make the noise of the sensor larger in the recording of the finer "
        "grating, which would be enough to tell it. But below 3 Hz, where little of the noise is left, the result is the same. That is a "
        "texture read from spikes, from one recording of each grating.",
        "The thesis's FA-I are silent here: 5 mm/s over a grating changes the load by a few newtons in a second, and the thesis's press by "
        "some 50. Amplified far beyond the thesis's forces (plot of the scale) they tell surfaces apart as the changes of readings do.",
        "FA-I calibrated to nerves fire throughout, at a rate of the noise of the sensor. SA-I calibrated to nerves tell less about load "
        "than "
        "the thesis's SA-I: their front end is compressive.",
        "Force: a count is 10 mN, our choice. The mean reading is then 1.2 N in the light and 2.0 N in the firm grip, in the range of the "
        "thesis's press, 0.2 to 4 N. Without the mean load each taxel has a mean of 2 N and changes by 1 N (root mean square, mean over "
        "the "
        "recordings); without the depth by 1 N in each recording. Negative forces are 0. Outliers of the recordings are left in place.",
        fmt::format(
            "Chips take most of the time, so they have {} of the 16 taxels, every second one, and the first {:g} s of the recordings "
            "at 20 and 5 mm/s. Models beside them have the same windows and taxels.",
            chip_taxels, chip_duration)};
}

Result<StudyResult> compute(const StudyOptions& options) {
    const auto path = TRY(options.recordings_in(folder));
    const auto fabrics = TRY(read_fabrics(path)), gratings = TRY(read_gratings(path)), slow_gratings = TRY(read_slow_gratings(path));
    StudyResult out;
    claim_fabrics(out, fabrics);
    claim_gratings(out, gratings);
    for (const auto* surfaces : {&gratings, &slow_gratings}) claim_change_shape(out, *surfaces);
    count_without_load(out, fabrics);
    for (const auto* surfaces : {&fabrics, &gratings}) {
        for (const auto& [part, part_name] : parts) report_part(out, *surfaces, part, part_name);
        TRY(sweep_scale(out, *surfaces));
    }
    report_part(out, slow_gratings, SlidePart::change_shape, "without mean load and depth");
    TRY(sweep_windows(out, fabrics));
    TRY(options.report_progress(0.2));
    TRY(compare_texture_chips(out, fabrics, SlidePart::all, "as recorded",
                              [&](double f) { return options.should_continue(0.2 + 0.5 * f); }));
    TRY(compare_texture_chips(out, gratings, SlidePart::change_shape, "without mean load and depth",
                              [&](double f) { return options.should_continue(0.7 + 0.3 * f); }));
    out.notes = notes();
    return out;
}

const Study study{
    "texture",
    "A texture task: fabrics and gratings under a sliding fingertip",
    "Do the spikes of SA-I and FA-I tell surfaces apart, and do they keep what the readings of the sensors tell? The thesis names "
    "textures as a use of artificial mechanoreceptors (1.1 and 1.3), without a number. All recordings of FabricSlide that we have",
    ClaimKind::ours,
    compute,
    folder};

}  // namespace corpuscle::studies::texture
