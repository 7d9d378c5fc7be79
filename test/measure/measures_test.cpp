#include "measure/measures.hpp"

#include <cmath>
#include <numeric>

#include "support/property.hpp"

namespace corpuscle {
namespace {

const std::vector<double> train = {0.1, 0.2, 0.25, 0.45, 0.95};

/// One measure of a train in one time window, computed by the accumulator.
double measured(std::string_view name, const std::vector<double>& spikes, const TimeWindow& window) {
    MeasureAccumulator tally({window}, 1);
    for (const double t : spikes) tally.spike(0, t);
    for (std::size_t m = 0; m < std::size(measures); ++m)
        if (measures[m].name == name) return tally.values(0, 0)[m];
    throw std::invalid_argument(std::string(name));
}

TEST(Measures, RatesOfAPhaseUseTheIntervalsOfItsSpikes) {
    const TimeWindow hold{0.2, 0.5};
    EXPECT_EQ(measured("spikes", train, hold), 3);
    EXPECT_NEAR(measured("mean_rate", train, hold), 10, 1e-9);
    EXPECT_NEAR(measured("first_rate", train, hold), 20, 1e-9);
    EXPECT_NEAR(measured("peak_rate", train, hold), 20, 1e-9);
    EXPECT_NEAR(measured("last_rate", train, hold), 5, 1e-9) << "from the last interval inside the phase, not the one that leaves it";
}

TEST(Measures, APhaseIncludesItsStartAndNotItsEnd) {
    EXPECT_EQ(measured("spikes", train, {0.1, 0.2}), 1);
    EXPECT_EQ(measured("spikes", train, {0.2, 0.25}), 1);
}

TEST(Measures, AreNaNWhereTheyAreNotDefined) {
    for (const auto& m : measures) {
        const double empty = measured(m.name, {}, {0, 1, 10}), last = measured(m.name, train, {0.9, 1});
        if (m.name == "spikes" || m.name == "mean_rate") {
            EXPECT_EQ(empty, 0) << m.name;
            EXPECT_GT(last, 0) << m.name;
        } else if (m.name == "entrainment") {
            EXPECT_EQ(empty, 0) << "ten cycles, none with a spike";
            EXPECT_TRUE(std::isnan(last)) << "no cycle";
        } else if (m.name == "latency") {
            EXPECT_TRUE(std::isnan(empty));
            EXPECT_NEAR(last, 0.05, 1e-12);
        } else {
            EXPECT_TRUE(std::isnan(empty) && std::isnan(last)) << m.name << ": the last spike of the train has no frequency";
        }
    }
    EXPECT_TRUE(std::isnan(measured("mean_rate", train, {0.5, 0.5})));
}

/// Trains of `count` presses of about half a second. In each the interval between spikes grows from 20 to 40 ms. `pause` (s) is the time
/// between presses.
std::vector<double> presses(int count, double pause) {
    std::vector<double> spikes;
    double t = 1;
    for (int k = 0; k < count; ++k, t += pause)
        for (double interval = 0.02; interval < 0.04; interval *= 1.05) spikes.push_back(t += interval);
    return spikes;
}

TEST(Measures, HaveNoAdaptationAndNoVariationAcrossLongPauses) {
    const TimeWindow all{0, 1000};
    for (const char* name : {"adaptation_ratio", "isi_cv"}) {
        EXPECT_FALSE(std::isnan(measured(name, presses(1, 0), all))) << name;
        EXPECT_TRUE(std::isnan(measured(name, presses(13, 9), all))) << name;
        EXPECT_FALSE(std::isnan(measured(name, presses(13, 0.03), all))) << name << ": no pause";
        auto irregular = presses(1, 0);
        irregular.insert(irregular.begin(), {0.1, 0.6});
        EXPECT_FALSE(std::isnan(measured(name, irregular, all))) << name << ": an irregular beginning is not a pause";
        auto isolated = presses(2, 5);
        isolated.insert(isolated.begin(), -8);
        EXPECT_TRUE(std::isnan(measured(name, isolated, {-10, 1000}))) << name << ": an isolated spike, then presses";
    }
    EXPECT_NEAR(measured("peak_rate", presses(13, 9), all), measured("peak_rate", presses(1, 0), all), 1e-6) << "within a press";
    auto press = presses(1, 0);
    EXPECT_FALSE(std::isnan(measured("last_rate", press, all)));
    press.push_back(press.back() + 7);
    EXPECT_TRUE(std::isnan(measured("last_rate", press, all))) << "the last interval is a pause";
}

TEST(Measures, AnIntervalOfMoreThanTenSecondsHasNoFrequency) {
    for (const char* name : {"peak_rate", "first_rate", "last_rate"}) {
        EXPECT_TRUE(std::isnan(measured(name, {1, 62}, {0, 133}))) << name;
        EXPECT_NEAR(measured(name, {1, 3}, {0, 133}), 0.5, 1e-12) << name << ": slow, but not a pause";
    }
    EXPECT_EQ(measured("mean_rate", {1, 62}, {0, 100}), 0.02);
}

TEST(Measures, TwoSpikesOnOneSampleHaveNoFrequency) {
    const std::vector<double> sampled = {0.1, 0.1, 0.2};
    EXPECT_TRUE(std::isnan(measured("first_rate", sampled, {0, 1})));
    EXPECT_NEAR(measured("peak_rate", sampled, {0, 1}), 10, 1e-9);
    EXPECT_TRUE(std::isnan(measured("adaptation_ratio", {0.1, 0.2, 0.2}, {0, 1})));
}

TEST(Measures, InstantaneousRatesAreOneFewerThanSpikes) {
    EXPECT_EQ(instantaneous_rates(train).size(), 4U);
    EXPECT_TRUE(instantaneous_rates({}).empty());
    EXPECT_NEAR(instantaneous_rates(train)[0], 10, 1e-9);
}

TEST(Measures, EachHasAUniqueNameATitleAndADescription) {
    for (const auto& m : measures) {
        EXPECT_FALSE(m.title.empty() || m.description.empty()) << m.name;
        EXPECT_EQ(std::count_if(std::begin(measures), std::end(measures), [&](const MeasureInfo& o) { return o.name == m.name; }), 1)
            << m.name;
    }
}

TEST(Measures, LatencyIsMeasuredFromTheStartOfThePhase) {
    EXPECT_NEAR(measured("latency", train, {0.2, 0.5}), 0, 1e-12) << "a spike on the start";
    EXPECT_NEAR(measured("latency", train, {0.3, 0.5}), 0.15, 1e-12);
    EXPECT_TRUE(std::isnan(measured("latency", train, {0.5, 0.9})));
}

TEST(Measures, AdaptationIsTheFirstIntervalOverTheLast) {
    EXPECT_NEAR(measured("adaptation_ratio", train, {0, 0.5}), 0.5, 1e-9) << "0.1 s, then 0.2 s; the 0.5 s after the phase do not count";
    EXPECT_TRUE(std::isnan(measured("adaptation_ratio", train, {0.2, 0.4}))) << "a single interval has no ratio";
    EXPECT_NEAR(measured("adaptation_ratio", {1, 2, 3, 4}, {0, 9}), 1, 1e-12);
}

TEST(Measures, VariationUsesAllIntervalsWithinThePhase) {
    EXPECT_NEAR(measured("isi_cv", {1, 2, 3, 4}, {0, 9}), 0, 1e-12) << "regular intervals";
    EXPECT_NEAR(measured("isi_cv", {0, 1, 4, 99}, {0, 9}), 0.5, 1e-12) << "1 s and 3 s: a deviation of 1 s about 2 s";
    EXPECT_TRUE(rc::check("equals a computation in two passes", [] {  // intervals that are not pauses
        const auto steps = *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(2, 50), rc::gen::inRange(1, 500));
        std::vector<double> spikes = {1e3};
        for (const int x : steps) spikes.push_back(spikes.back() + x * 1e-3);
        const auto n = static_cast<double>(steps.size());
        const double mean = std::accumulate(steps.begin(), steps.end(), 0.0) / n;
        double squares = 0;
        for (const int x : steps) squares += (x - mean) * (x - mean);
        RC_ASSERT(std::abs(measured("isi_cv", spikes, {0, 1e9}) - std::sqrt(squares / n) / mean) < 1e-9);
    }));
}

TEST(Measures, VectorStrengthIsOneForPhaseLockingAndZeroForUniformPhases) {
    std::vector<double> locked, twice, spread;
    for (int k = 0; k < 100; ++k) {
        locked.push_back((k + 0.3) / 25.0);
        twice.push_back((k + 0.3) / 50.0);
        spread.push_back((k + k / 100.0) / 25.0);
    }
    const TimeWindow s{0, 4, 25};
    EXPECT_NEAR(measured("vector_strength", locked, s), 1, 1e-9);
    EXPECT_NEAR(measured("vector_strength", twice, {0, 2, 25}), 0, 1e-9) << "two spikes per cycle, at opposite phases";
    EXPECT_NEAR(measured("vector_strength", spread, s), 0, 1e-9);
    EXPECT_EQ(measured("entrainment", locked, s), 1);
    EXPECT_EQ(measured("entrainment", twice, {0, 2, 25}), 0) << "two spikes in a cycle do not count as one";
    EXPECT_TRUE(std::isnan(measured("vector_strength", locked, {0, 4})));
    EXPECT_TRUE(std::isnan(measured("entrainment", locked, {0, 4}))) << "the window has no cycles";
}

TEST(Measures, SpikesAfterTheLastCompleteCycleDoNotCount) {
    const std::vector<double> spikes = {1.25, 2.25, 3.75};  // at 1 Hz from 1 s; the third spike is in an incomplete cycle
    EXPECT_NEAR(measured("vector_strength", spikes, {1, 3.9, 1}), 1, 1e-9);
    EXPECT_EQ(measured("entrainment", spikes, {1, 3.9, 1}), 1);
    EXPECT_NEAR(measured("vector_strength", spikes, {1, 4, 1}), 1.0 / 3, 1e-9);
    EXPECT_NEAR(measured("entrainment", {1.25, 3.25}, {1, 4, 1}), 2.0 / 3, 1e-9);
}

/// Compares with the definitions of spikes, peak_rate, first_rate and last_rate, computed from the entire train.
TEST(MeasureAccumulator, GivesTheValuesOfTheEntireTrainForAnyDivisionIntoPhases) {
    EXPECT_TRUE(rc::check("equals a computation from the entire train", [] {
        const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 40));
        const auto edges = *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(1, 6), rc::gen::inRange(0, 100));
        std::vector<double> spikes;
        int at = 0;
        for (const int x : steps) spikes.push_back(1e-2 * (at += x));
        std::vector<TimeWindow> windows;
        int edge = *rc::gen::inRange(0, 50);
        for (const int x : edges) windows.push_back({1e-2 * edge, 1e-2 * (edge + x)}), edge += x + *rc::gen::element(0, 3);
        MeasureAccumulator tally(windows, 2);
        for (const double t : spikes) tally.spike(1, t);
        for (std::size_t p = 0; p < windows.size(); ++p) {
            const auto begin = std::lower_bound(spikes.begin(), spikes.end(), windows[p].from);
            const auto end = std::max(begin, std::lower_bound(spikes.begin(), spikes.end(), windows[p].to));
            const auto rates = instantaneous_rates(std::vector<double>(begin, end == spikes.end() ? end : end + 1));
            const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
            const auto values = tally.values(1, p);
            double peak = no_value;
            for (std::size_t k = 0; k < rates.size() && begin != end; ++k) peak = std::fmax(peak, rates[k]);
            RC_ASSERT(values[0] == static_cast<double>(end - begin));
            RC_ASSERT(same(values[2], peak));
            RC_ASSERT(same(values[3], begin == end || rates.empty() ? no_value : rates[0]));
            RC_ASSERT(same(values[4], end - begin < 2 ? no_value : rates[static_cast<std::size_t>(end - begin) - 2]));
            RC_ASSERT(tally.values(0, p)[0] == 0);
        }
    }));
}

}  // namespace
}  // namespace corpuscle
