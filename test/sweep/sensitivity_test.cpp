// Sensitivity to devices: those with a known influence are found with their fraction of the variance, and noise is not.

#include "sweep/stats/sensitivity.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "circuit/device/uicm_card.hpp"
#include "circuit/netlist/netlist.hpp"
#include "core/random.hpp"
#include "sweep/stats/sweep_summary.hpp"
#include "synthetic_sweep.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::SyntheticSweep, test::value_or_throw;

std::vector<SweepFactor> noise_factors(std::uint64_t seed, std::size_t items, std::size_t factors) {
    std::vector<SweepFactor> out(factors);
    for (std::size_t f = 0; f < factors; ++f)
        for (std::size_t k = 0; k < items; ++k) out[f].push_back(normal(seed, static_cast<std::uint32_t>(f), 1, k));
    return out;
}

TEST(Sensitivity, NoiseIsNotReportedAsInfluence) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const auto factors = noise_factors(seed, 200, 100);
        std::vector<double> measure;
        for (std::uint64_t k = 0; k < 200; ++k) measure.push_back(std::exp(2 * normal(1000 + seed, 0, 2, k)));  // with long tails
        found += !sensitivity_of(measure, factors).influences.empty();
    }
    EXPECT_LE(found, 2);  // 0.3 are expected; more than 2 occur once in 300 times
}

TEST(Sensitivity, FractionsAreTheSquaresOfTheSlopesAndLieInTheirIntervals) {
    const double slopes[] = {0.6, -0.3, 0.1};
    double variance = 0.25;
    for (const double s : slopes) variance += s * s;
    int all_found = 0, inside = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const auto factors = noise_factors(seed, 1000, 60);
        std::vector<double> measure;
        for (std::size_t k = 0; k < 1000; ++k) {
            measure.push_back(0.5 * normal(2000 + seed, 0, 2, k) + 7);
            for (std::size_t f = 0; f < 3; ++f) measure.back() += slopes[f] * factors[f][k];
        }
        const auto s = sensitivity_of(measure, factors);
        if (s.influences.size() < 3) continue;
        ++all_found;
        EXPECT_EQ(s.influences[0].factor, 0U);
        EXPECT_EQ(s.influences[1].factor, 1U);
        EXPECT_NEAR(s.influences[0].slope, 0.6, 0.06);
        EXPECT_NEAR(s.influences[1].slope, -0.3, 0.06);
        EXPECT_NEAR(s.explained, 1 - 0.25 / variance, 0.05);
        const auto& first = s.influences[0].fraction;
        inside += first.low <= 0.36 / variance && 0.36 / variance <= first.high;
    }
    EXPECT_GE(all_found, 13);
    EXPECT_GE(inside, all_found * 9 / 10 - 2);
}

TEST(Sensitivity, ADependentOrConstantFactorIsNotSelected) {
    auto factors = noise_factors(1, 200, 3);
    factors.push_back(factors[0]);
    factors.emplace_back(200, 4.0);
    std::vector<double> measure(200);
    for (std::size_t k = 0; k < 200; ++k) measure[k] = factors[0][k];
    measure[5] = std::nan("");
    const auto s = sensitivity_of(measure, factors);
    EXPECT_EQ(s.items, 199U);
    ASSERT_EQ(s.influences.size(), 1U);
    EXPECT_NEAR(s.influences[0].fraction.value, 1, 1e-9);
    EXPECT_NEAR(s.explained, 1, 1e-9);
    EXPECT_TRUE(sensitivity_of(std::vector<double>(200, 3.0), factors).influences.empty());
    EXPECT_TRUE(sensitivity_of(std::vector<double>{1, 2}, std::vector<SweepFactor>{{1, 2}}).influences.empty());
}

TEST(Sensitivity, FourTimesTheAreaHalvesTheContributionOfADevice) {
    EXPECT_DOUBLE_EQ(relative_sigma_at_four_times_area(1), 0.5);
    EXPECT_DOUBLE_EQ(relative_sigma_at_four_times_area(0), 1);
    EXPECT_DOUBLE_EQ(relative_sigma_at_four_times_area(0.64), std::sqrt(0.36 + 0.16));
}

TEST(MismatchSamples, DevicesAreListedInSamplingOrderWithTheDeviatesOfTheChip) {
    const auto netlist = value_or_throw(circuit::Netlist::parse(
        "t\n.model nch nmos (level=80 avt=3e-9 ais=1e-8)\n.model pch pmos (level=80)\nv1 d 0 1\nm1 d d 0 0 nch w=2u l=0.5u m=3 stack=2\n"
        ".subckt s a\nm2 a a 0 0 pch w=1u l=1u\n.ends\nx1 d s\nr1 d 0 1k\nm3 d d 0 0 nch\n.end\n",
        "t.cir", [](const std::string&) -> Result<std::string> { return bad_input("none"); }));
    const auto circuit = value_or_throw(netlist.elaborate());
    MismatchSamples mismatch_samples{9, 0, {{"t", mismatch_devices(circuit)}}};
    mismatch_samples = value_or_throw(parse_mismatch_samples(format_mismatch_samples(mismatch_samples)));
    const auto& devices = mismatch_samples.subjects[0].devices;
    ASSERT_EQ(devices.size(), 3U);
    EXPECT_EQ(devices[0].name, "m1");
    EXPECT_EQ(devices[1].name, "x1.m2");
    EXPECT_TRUE(devices[1].pmos);
    EXPECT_EQ(devices[1].sigma_VT, 0);
    EXPECT_NEAR(devices[0].area(), 6e-12, 1e-24);
    const circuit::UicmCard card{.A_VT = 3e-9, .A_IS = 1e-8};
    const circuit::UicmInstance size{.W = 2e-6, .L = 0.5e-6, .m = 3, .stack = 2};
    const auto own = deviates_of(devices[0], mismatch_samples.seed, {0, 41});
    const auto shift = circuit::sample_mismatch(card, size, 9, 0, 41);
    EXPECT_NEAR(own.V_T[1] * devices[0].sigma_VT, shift.V_T, 1e-12);
    EXPECT_NEAR(own.I_S[1] * devices[0].sigma_IS, std::log(shift.factor), 1e-12);
    EXPECT_FALSE(parse_mismatch_samples("{\"seed\":1"));
    EXPECT_FALSE(parse_mismatch_samples("{\"seed\":1,\"chips\":0,\"subjects\":[{\"name\":\"a\",\"devices\":[[1]]}]}"));
}

class SyntheticSweepSummary : public testing::Test {
protected:
    static inline SweepSummary summary;
    static inline SweepTable table;
    static inline std::unique_ptr<SyntheticSweep> sweep;
    void SetUp() override {
        if (sweep) return;
        const TemporaryFolder folder;
        sweep = std::make_unique<SyntheticSweep>(1000);
        const auto results = test::write_synthetic_results(folder / "made.sqlite", *sweep);
        table = value_or_throw(read_table(results, {}));
        summary = value_or_throw(summary_of(table, value_or_throw(parse_mismatch_samples(results.about(mismatch_metadata_name))), {}));
    }
    static void TearDownTestSuite() { sweep.reset(), table = {}, summary = {}; }
};

TEST_F(SyntheticSweepSummary, PointsAreTheTemperaturesAndEndsAndYieldsAreCounted) {
    ASSERT_EQ(summary.points.size(), 3U);  // the corner has one value, the process 1000
    EXPECT_EQ(summary.points[2].label, "temp = 85 C");
    EXPECT_EQ(summary.all.items, 3000);
    EXPECT_EQ(summary.all.iteration_limit, 60);
    EXPECT_EQ(summary.all.diverged, 6);
    std::int64_t passed = 0, line_passed = 0, count_passed = 0;
    for (std::int64_t item = 0; item < sweep->item_count; ++item) {
        const auto o = sweep->outcome(item);
        const bool done = o.end == ItemEnd::done, line_is_within = done && std::abs(o.measures[0]) <= 0.5,
                   count_is_within = done && o.measures[2] >= 3;
        passed += line_is_within && count_is_within, line_passed += line_is_within, count_passed += count_is_within;
    }
    EXPECT_EQ(summary.all.passed, passed);
    EXPECT_EQ(summary.all.measures[0].yield->value, static_cast<double>(line_passed) / 3000);
    EXPECT_EQ(summary.all.measures[2].yield->value, static_cast<double>(count_passed) / 3000);
    EXPECT_FALSE(summary.all.measures[1].yield);
    EXPECT_EQ(summary.all.measures[0].missing, 6);
    EXPECT_EQ(table.measures.back().name, "iterations");
    EXPECT_EQ(summary.all.measures.back().min, 300);
}

TEST_F(SyntheticSweepSummary, DevicesOfKnownInfluenceAreFoundAndRankedAndNoOthers) {
    const auto& line = summary.dependences[0];
    ASSERT_EQ(line.devices.size(), 3U);
    EXPECT_EQ(line.devices[0].device, 7);
    EXPECT_EQ(line.devices[1].device, 20);
    EXPECT_EQ(line.devices[2].device, 3);
    EXPECT_EQ(line.devices[0].I_S, 0);
    EXPECT_EQ(line.devices[1].V_T, 0);
    // Each item has its own noise, and each chip its deviates, so the mean over three temperatures has a third of the noise's variance.
    const double variance = 0.09 + 0.04 + 0.01 + 0.01 + 0.0225 / 3;
    EXPECT_NEAR(line.devices[0].fraction(), 0.09 / variance, 0.05);
    EXPECT_NEAR(line.devices[1].fraction(), 0.04 / variance, 0.04);
    EXPECT_NEAR(line.devices[2].fraction(), 0.01 / variance, 0.02);
    ASSERT_EQ(line.influences.size(), 4U);
    EXPECT_EQ(std::count_if(line.influences.begin(), line.influences.end(), [](const auto& i) { return i.name == "process.vt_n"; }), 1);
    EXPECT_NEAR(line.sensitivity.explained, 1 - 0.0075 / variance, 0.02);
    ASSERT_EQ(line.points.size(), 1U);
    const double between = 2.0 / 9;  // of 0, 0, 1 V
    EXPECT_NEAR(line.points[0].second.fraction, between / (between + variance + 0.015), 0.03);
    EXPECT_TRUE(summary.dependences[1].influences.empty()) << "noise";
    EXPECT_TRUE(summary.dependences[3].influences.empty()) << "iterations";
    const auto& yield = summary.dependences.back();
    EXPECT_EQ(yield.measure, "yield");
    EXPECT_EQ(yield.points.size(), 1U);
    ASSERT_FALSE(yield.devices.empty());
    EXPECT_EQ(yield.devices[0].device, 7);
}

TEST_F(SyntheticSweepSummary, TheDocumentHasTheContentsOfTheSummary) {
    const auto document = document_of(table, summary, "made");
    EXPECT_EQ(document["finished"], 3000);
    EXPECT_EQ(document["all"]["passed"], summary.all.passed);
    EXPECT_EQ(document["points"][1]["measures"][0]["mean"]["low"], summary.points[1].measures[0].mean.low);
    const auto& device = document["depends_on"][0]["devices"][0];
    EXPECT_EQ(device["device"], "x1.m7");
    EXPECT_NEAR(device["area_m2"].get<double>(), 8e-12, 1e-20);
    const double fraction = device["fraction"], relative_sigma = device["relative_sigma_at_4x_area"];
    EXPECT_NEAR(relative_sigma * relative_sigma, 1 - 0.75 * fraction, 1e-12);
}

TEST_F(SyntheticSweepSummary, AnAxisOfManyValuesIsDividedIntoBandsAndAWrongNameGetsASuggestion) {
    const auto bands = value_or_throw(group_rows(table, {"process.vt_n"}));
    ASSERT_EQ(bands.groups.size(), SweepGroups::bands);
    for (const auto& g : bands.groups) EXPECT_NEAR(static_cast<double>(g.rows.size()), 600, 10);
    const auto wrong = group_rows(table, {"tmep"});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message, "--by tmep: unknown axis; did you mean 'temp'? (known: temp, corner, process.vt_n)");
}

}  // namespace
}  // namespace corpuscle
