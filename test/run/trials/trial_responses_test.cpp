// Measures of trials, statistics by label, and histograms: closed forms and properties.

#include "run/trials/trial_responses.hpp"

#include <algorithm>
#include <cmath>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

using Trains = std::vector<std::vector<double>>;

std::vector<AlignedTrial> aligned(const std::vector<Trial>& trials, double stop, const TrialOptions& options = {},
                                  const std::vector<double>& onsets = {}) {
    return value_or_throw(align_trials(trials, 0, stop, onsets, options));
}

/// The responses of one afferent.
TrialResponses responses_of(const std::vector<AlignedTrial>& trials, const std::vector<double>& train) {
    TrialResponses out;
    const std::size_t index[] = {out.add_afferent("sa1", "fz", "sa1")};
    out.add(trials, Trains{train}, index);
    return out;
}

TEST(TrialResponses, CountEverySpikeOnceIfTrialsCoverARecording) {
    EXPECT_TRUE(rc::check("adjacent trials", [] {
        const double end = 10;
        auto edges = *rc::gen::container<std::vector<double>>(rc::gen::map(rc::gen::inRange(1, 999), [](int k) { return k / 100.0; }));
        edges.push_back(0), edges.push_back(end);
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        auto train = *rc::gen::container<std::vector<double>>(rc::gen::map(rc::gen::inRange(0, 2000), [](int k) { return k / 200.0; }));
        std::sort(train.begin(), train.end());
        std::vector<Trial> trials;
        for (std::size_t k = 0; k + 1 < edges.size(); ++k) trials.push_back({edges[k], edges[k + 1], k % 2 ? "a" : "b"});
        const auto all = responses_of(aligned(trials, end), train);
        std::size_t count = 0;
        double counted = 0;
        for (const auto& r : all.responses) count += r.spikes.size(), counted += r.values[measure_index<SpikeCount>()];
        RC_ASSERT(count == train.size());
        RC_ASSERT(counted == static_cast<double>(train.size()));
    }));
}

TEST(TrialResponses, AreTheSameForOverlappingTrialsAsForEachAlone) {
    const std::vector<double> train = {0.1, 0.15, 0.4, 0.45, 0.9, 1.3, 1.31};
    const std::vector<Trial> trials = {{0, 1, "a"}, {0.3, 1.4, "a"}, {0.3, 1.4, "b"}};
    const auto all = responses_of(aligned(trials, 2), train);
    for (std::size_t t = 0; t < trials.size(); ++t) {
        const auto alone = responses_of(aligned({trials[t]}, 2), train);
        EXPECT_EQ(all.responses[t].spikes, alone.responses[0].spikes);
        for (std::size_t m = 0; m < std::size(measures); ++m)
            EXPECT_TRUE(all.responses[t].values[m] == alone.responses[0].values[m] || std::isnan(alone.responses[0].values[m]));
    }
}

TEST(TrialResponses, MeasureTheWindowAndCountLatencyFromTheAlignment) {
    TrialOptions options{.alignment = AlignmentPoint::onset, .window = std::pair(-0.1, 0.5)};
    const auto trials = aligned({{1, 3, "a"}, {4, 6, "a"}}, 5, options, {1.5, 2.5, 4.8});
    EXPECT_EQ(trials[0].zero, 1.5) << "the first contact in the trial";
    EXPECT_EQ(trials[0].from, -0.1);
    EXPECT_EQ(trials[1].zero, 4.8);
    EXPECT_NEAR(trials[1].to, 0.2, 1e-12) << "the recording ends";
    const auto all = responses_of(trials, {1.0, 1.42, 1.53, 1.55, 1.99, 2.0, 4.75});
    const auto& first = all.responses[0].values;
    EXPECT_EQ(first[measure_index<SpikeCount>()], 4);
    EXPECT_NEAR(first[measure_index<MeanRate>()], 4 / 0.6, 1e-9);
    EXPECT_NEAR(first[measure_index<Latency>()], 0.03, 1e-12) << "not from the start of the window, in which an earlier spike is";
    EXPECT_NEAR(first[measure_index<PeakRate>()], 1 / 0.01, 1e-6) << "of the last spike in the window with the next one";
    EXPECT_TRUE(std::isnan(all.responses[1].values[measure_index<Latency>()])) << "its only spike is before the contact";
}

TEST(TrialResponses, LeaveTrialsWithoutAnOnsetOutOfMeans) {
    TrialOptions options{.alignment = AlignmentPoint::onset};
    const auto all = responses_of(aligned({{0, 1, "a"}, {1, 2, "a"}}, 2, options, {0.5}), {0.6, 1.1});
    EXPECT_FALSE(all.trials[1].has_zero());
    EXPECT_TRUE(std::isnan(all.responses[1].values[measure_index<SpikeCount>()]));
    EXPECT_EQ(all.label_rows()[0].statistics[measure_index<SpikeCount>()].copies, 1);
    const auto histograms = value_or_throw(all.histograms(0.1, {}));
    for (const auto& bin : histograms[0].bins) EXPECT_LE(bin.rate.copies, 1);
}

TEST(TrialResponses, HaveMeansDeviationsAndHistogramsInClosedForm) {
    // Trials of 1 s with 1, 2 and 3 spikes, all in the bin from 0.2 s to 0.3 s.
    const std::vector<double> train = {0.25, 1.21, 1.22, 2.21, 2.22, 2.29};
    const auto all = responses_of(aligned({{0, 1, "a"}, {1, 2, "a"}, {2, 3, "a"}}, 3), train);
    const auto row = all.label_rows()[0];
    EXPECT_EQ(row.statistics[measure_index<SpikeCount>()].mean(), 2);
    EXPECT_EQ(row.statistics[measure_index<SpikeCount>()].standard_deviation(), 1);
    const auto histogram = value_or_throw(all.histograms(0.1, {}))[0];
    ASSERT_EQ(histogram.bins.size(), 10U);
    for (std::size_t b = 0; b < 10; ++b) {
        const auto& bin = histogram.bins[b];
        EXPECT_EQ(bin.rate.copies, 3);
        EXPECT_EQ(bin.spikes, b == 2 ? 6 : 0);
        EXPECT_NEAR(bin.rate.mean(), b == 2 ? 20 : 0, 1e-9);
        EXPECT_NEAR(bin.standard_error(), b == 2 ? 10 / std::sqrt(3.0) : 0, 1e-9);
    }
}

TEST(TrialResponses, CountATrialOnlyInTheBinsThatItCovers) {
    const auto all = responses_of(aligned({{0, 1, "a"}, {1, 1.55, "a"}}, 2), {0.05, 0.95, 1.05, 1.52});
    const auto bins = value_or_throw(all.histograms(0.1, {}))[0].bins;
    ASSERT_EQ(bins.size(), 10U);
    for (std::size_t b = 0; b < 10; ++b) EXPECT_EQ(bins[b].rate.copies, b < 5 ? 2 : 1) << b;
    EXPECT_EQ(bins[0].rate.mean(), 10);
    EXPECT_EQ(bins[5].spikes, 0) << "the spike at 0.52 s is in a bin that its trial does not cover";
    EXPECT_NEAR(bins[9].rate.mean(), 10, 1e-12);
}

TEST(TrialResponses, AverageOverTheAfferentsOfAGroup) {
    TrialResponses all;
    const std::size_t indexes[] = {all.add_afferent("sa1#1", "tip", "sa1"), all.add_afferent("sa1#2", "tip", "sa1")};
    all.keeps_silent = false;
    all.add(aligned({{0, 1, "a"}}, 1), Trains{{0.1, 0.2}, {}}, indexes);
    ASSERT_EQ(all.groups.size(), 1U);
    EXPECT_EQ(all.responses.size(), 1U) << "only the one that fired";
    EXPECT_EQ(all.label_rows()[0].statistics[measure_index<SpikeCount>()].mean(), 1);
    EXPECT_EQ(value_or_throw(all.histograms(1, {}))[0].bins[0].rate.mean(), 1);
}

TEST(TrialResponses, AverageAClassOverItsAfferentsInAllRegions) {
    TrialResponses all;  // a class with two afferents in one region and one in another, and a class with a silent afferent
    const std::size_t indexes[] = {all.add_afferent("sa1#1", "tip", "sa1"), all.add_afferent("sa1#2", "tip", "sa1"),
                                   all.add_afferent("fa1#1", "tip", "fa1"), all.add_afferent("sa1#3", "palm", "sa1")};
    all.add(aligned({{0, 1, "a"}, {1, 2, "a"}}, 2), Trains{{0.1, 0.2, 1.1}, {0.3}, {}, {0.6, 0.7, 1.2, 1.3}}, indexes);
    const auto classes = all.groups_by_name();
    ASSERT_EQ(classes.groups.size(), 2U);
    EXPECT_EQ(std::tie(classes.groups[0].name, classes.groups[0].afferents), std::tuple("sa1", 3U));
    EXPECT_EQ(std::tie(classes.groups[1].name, classes.groups[1].afferents), std::tuple("fa1", 1U));
    const auto histograms = value_or_throw(all.histograms(1, {}, classes));
    ASSERT_EQ(histograms.size(), 2U);
    ASSERT_EQ(histograms[0].bins.size(), 1U);
    const auto& bin = histograms[0].bins[0];  // 5 / 3 Hz in the first trial, 1 Hz in the second
    EXPECT_EQ(bin.spikes, 8);
    EXPECT_NEAR(bin.rate.mean(), 4. / 3, 1e-15);
    EXPECT_NEAR(bin.rate.standard_deviation(), (5. / 3 - 1) / std::sqrt(2), 1e-15);
    EXPECT_EQ(histograms[1].bins[0].rate.mean(), 0);
    EXPECT_EQ(histograms[1].bins[0].rate.copies, 2);
}

TEST(TrialResponses, RefuseTrialsOutsideTheRecordingAndTooManyBins) {
    const auto outside = align_trials(std::vector<Trial>{{5, 6, "late", 7}}, 0, 5, {}, {});
    ASSERT_FALSE(outside);
    EXPECT_NE(outside.error().message.find("trial 'late' from 5 s to 6 s is outside of the recording"), std::string::npos);
    EXPECT_EQ(outside.error().location.line, 7);
    EXPECT_FALSE(responses_of(aligned({{0, 1, "a"}}, 1), {}).histograms(1e-7, {}));
}

TEST(TrialLabels, AreNamesOfFilesWithoutTheNumberAtTheirEnd) {
    for (const auto& [name, label] : {std::pair{"press_03", "press"},
                                      {"press-12", "press"},
                                      {"press 2", "press"},
                                      {"press", "press"},
                                      {"p2", "p2"},
                                      {"12", "12"},
                                      {"grip_a", "grip_a"}})
        EXPECT_EQ(label_of_input(name), label);
}

}  // namespace
}  // namespace corpuscle
