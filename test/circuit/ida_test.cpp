// Circuits in time against IDA of SUNDIALS on the same equations: how far off we are, and that it shrinks as it is asked to.

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "circuit/transient_runner.hpp"
#include "circuit/oscillator.hpp"

namespace corpuscle::circuit {
namespace {

const std::string loops = test::project_root() + "/test/circuit/loops/";

/// The thesis's high-pass filters with another course of force at their input, for so long.
TransientRunner high_pass(const std::string& course, const std::string& stop) {
    return TransientRunner::from_file(test::project_root() + "/circuits/high_pass.cir", {{"vf ", "vf vf 0 " + course}, {".ac", ".tran 1u " + stop}});
}

/// Of each run the largest distance of an unknown from IDA's, V, at its own points after `from`.
std::vector<double> distances(const TransientRunner& circuit, const std::vector<TransientPoints>& runs, const std::string& name, double from = 0) {
    IdaOptions asked;
    for (const auto& run : runs) asked.output_times.insert(asked.output_times.end(), run.t.begin(), run.t.end());
    std::sort(asked.output_times.begin(), asked.output_times.end());
    asked.output_times.erase(std::unique(asked.output_times.begin(), asked.output_times.end()), asked.output_times.end());
    asked.reltol = asked.vntol = 1e-10;
    const auto truth = circuit.run_ida(asked);
    EXPECT_EQ(truth.error, "");
    std::vector<double> out;
    const auto u = static_cast<std::size_t>(circuit.unknown(name));
    for (const auto& run : runs) {
        EXPECT_EQ(run.error, "");
        double most = 0;
        for (std::size_t k = 0; k < run.t.size(); ++k) {
            const auto at = std::lower_bound(asked.output_times.begin(), asked.output_times.end(), run.t[k]) - asked.output_times.begin();
            if (run.t[k] > from && static_cast<std::size_t>(at) < truth.x.size())
                most = std::max(most, std::abs(run.x[k][u] - truth.x[static_cast<std::size_t>(at)][u]));
        }
        out.push_back(most);
    }
    return out;
}

std::vector<double> true_spikes(const TransientRunner& circuit, const std::string& name, double level) {
    IdaOptions asked;
    asked.crossing_unknown = circuit.unknown(name), asked.crossing_level = level, asked.reltol = asked.vntol = 1e-9;
    const auto truth = circuit.run_ida(asked);
    EXPECT_EQ(truth.error, "");
    return truth.crossings;
}

std::vector<double> intervals(const std::vector<double>& spikes) {
    std::vector<double> out;
    for (std::size_t k = 1; k < spikes.size(); ++k) out.push_back(spikes[k] - spikes[k - 1]);
    return out;
}

/// Deviation by mean.
double spread(const std::vector<double>& x) {
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
    double sum = 0;
    for (const double one : x) sum += (one - mean) * (one - mean);
    return std::sqrt(sum / static_cast<double>(x.size())) / mean;
}

TransientPlan tight(double reltol) {
    TransientPlan plan;
    plan.reltol = reltol, plan.vntol = reltol / 10;
    return plan;
}

struct Rule {
    std::string name;
    Integration method;
    int order;
};
const Rule bdf[] = {
    {"BDF1", Integration::bdf, 1}, {"BDF2", Integration::bdf, 2}, {"BDF3", Integration::bdf, 3}, {"BDF4", Integration::bdf, 4}};
const Rule trapezoidal = {"trapezoidal", Integration::trapezoidal, 2};

/// Every step as long as the others, whatever its error.
TransientPlan even(double longest, const Rule& rule) {
    TransientPlan plan;
    plan.reltol = 1e9, plan.max_step = longest, plan.method = rule.method, plan.max_order = rule.order;
    return plan;
}

/// No decade of reltol may cost anything, three of them must bring thirty times (a second order's hundred, less what steps are made of).
void expect_falling(const std::vector<double>& off, double floor, const std::string& what) {
    for (std::size_t k = 1; k < off.size(); ++k)
        EXPECT_LT(off[k], std::max(off[k - 1], floor)) << what << ": at 1e-" << 3 + k << ", after " << off[k - 1];
    EXPECT_LT(off.back(), std::max(off.front() / 30, floor)) << what;
    testing::Test::RecordProperty(what, testing::PrintToString(off));
}

TEST(Ida, AnswersTheClosedFormOfAChargingCapacitor) {
    const auto rc = TransientRunner::from_text("rc\nv1 in 0 pwl(0 0 1m 0 1.001m 1)\nr1 in out 1k\nc1 out 0 1u\n.tran 1u 5m\n");
    IdaOptions asked;
    asked.crossing_unknown = rc.unknown("v(out)"), asked.crossing_level = 0.5;
    asked.output_times = {0.5e-3, 2e-3, 3e-3, 5e-3};
    const auto found = rc.run_ida(asked);
    ASSERT_EQ(found.error, "");
    ASSERT_EQ(found.x.size(), 4U);
    const auto exact = [](double t) { return 1 - 1e3 * std::expm1(1e-3) * std::exp(-(t - 1e-3) / 1e-3); };
    for (std::size_t k = 1; k < 4; ++k)
        EXPECT_NEAR(found.x[k][static_cast<std::size_t>(asked.crossing_unknown)], exact(asked.output_times[k]), 1e-7) << asked.output_times[k];
    ASSERT_EQ(found.crossings.size(), 1U);
    EXPECT_NEAR(exact(found.crossings[0]), 0.5, 1e-7);
}

TEST(Ida, IsSureOfAnOscillatorsSpikes) {
    const auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    IdaOptions asked;
    asked.crossing_unknown = oscillator.unknown("v(s)"), asked.crossing_level = 0.35;
    asked.reltol = asked.vntol = 1e-8;
    const auto loose = oscillator.run_ida(asked);
    asked.reltol = asked.vntol = 1e-10;
    const auto close = oscillator.run_ida(asked);
    ASSERT_EQ(loose.crossings.size(), close.crossings.size());
    for (std::size_t k = 0; k < close.crossings.size(); ++k)
        EXPECT_NEAR(loose.crossings[k], close.crossings[k], 1e-6 * close.crossings[k]) << k;
    EXPECT_LT(spread(intervals({close.crossings.begin() + 2, close.crossings.end()})), 1e-7);
}

TEST(InTimeOrder, ErrorsOfAFilterFallWithTheTolerance) {
    for (const auto* course : {"pwl(0 0.35 10m 0.35 11m 0.38)", "sin(0.35 0.03 20)"}) {
        const auto filter = high_pass(course, "0.2");
        std::vector<TransientPoints> runs;
        for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) runs.push_back(filter.run(tight(reltol)));
        expect_falling(distances(filter, runs, "v(hpb)"), 1e-8, course);
    }
}

/// The first steps are of first order: what they leave has gone when it is looked at.
TEST(InTimeOrder, ErrorsOfAFilterFallWithHalfTheStepAsTheOrderSays) {
    const auto filter = high_pass("sin(0.35 0.03 40)", "0.2");
    for (const auto& rule : {bdf[0], bdf[1], bdf[2], bdf[3], trapezoidal}) {
        const double coarse = rule.order > 3 ? 1e-3 : rule.order > 2 ? 400e-6 : 100e-6;
        std::vector<TransientPoints> runs;
        for (const double h : {coarse, coarse / 2, coarse / 4}) runs.push_back(filter.run(even(h, rule)));
        const auto off = distances(filter, runs, "v(hpb)", 0.1);
        for (std::size_t k = 1; k < off.size(); ++k)
            EXPECT_NEAR(std::log2(off[k - 1] / off[k]), rule.order, 0.2) << rule.name << ": " << off[k - 1] << " V, then " << off[k];
    }
}

TEST(InTimeOrder, AnOscillatorsSpikesComeNearerWithTheTolerance) {
    auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    oscillator.set_stop_time(0.4);
    const auto truth = true_spikes(oscillator, "v(s)", 0.35);
    ASSERT_GT(truth.size(), 8U);
    std::vector<double> off;
    for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto spikes = oscillator.spike_times(oscillator.run(tight(reltol)), "v(s)", 0.35);
        ASSERT_EQ(spikes.size(), truth.size()) << reltol;
        off.push_back(std::abs(spikes.back() - truth.back()));
    }
    expect_falling(off, 1e-6 * truth.back(), "oscillator");
}

/// A Schmitt trigger's edge is over in nanoseconds: even steps show no order there. A ring's waves they follow.
TEST(InTimeOrder, ARingsTimeComesFourTimesNearerWithHalfTheStep) {
    const auto ring = TransientRunner::from_file(loops + "ring.cir");
    const auto truth = true_spikes(ring, "v(a)", 0.35);
    ASSERT_GT(truth.size(), 3U);
    for (const auto& rule : {bdf[1], trapezoidal}) {
        std::vector<double> off;
        for (const double h : {0.8e-9, 0.4e-9, 0.2e-9}) {
            const auto rises = ring.spike_times(ring.run(even(h, rule)), "v(a)", 0.35);
            ASSERT_EQ(rises.size(), truth.size()) << h;
            off.push_back(std::abs(rises.back() - truth.back()));
        }
        for (std::size_t k = 1; k < off.size(); ++k)
            EXPECT_NEAR(off[k - 1] / off[k], 4, 0.5) << rule.name << ": " << off[k - 1] << " s, then " << off[k];
    }
}

TEST(InTimeDefaults, AnOscillatorKeepsItsTimeForASecond) {
    const auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    const auto truth = true_spikes(oscillator, "v(s)", 0.35);
    const auto spikes = oscillator.spike_times(oscillator.run({}), "v(s)", 0.35);
    ASSERT_EQ(spikes.size(), truth.size());
    const auto mine = intervals(spikes), theirs = intervals(truth);
    double worst = 0;
    for (std::size_t k = 0; k < mine.size(); ++k) worst = std::max(worst, std::abs(mine[k] / theirs[k] - 1));
    EXPECT_LT(worst, 1e-3) << "the worst interval";
    EXPECT_LT(spread({mine.begin() + 1, mine.end()}), 1e-4);
    EXPECT_NEAR(spikes.back(), truth.back(), 1e-3 * truth.back());
}

TEST(InTimeLoop, ItsLastSpikeStaysWithinAThousandthAtDefaults) {
    const auto loop = TransientRunner::from_file(loops + "loop.cir");
    const auto truth = true_spikes(loop, "v(s)", 0.35);
    ASSERT_GT(truth.size(), 20U);
    const auto spikes = loop.spike_times(loop.run({}), "v(s)", 0.35);
    ASSERT_EQ(spikes.size(), truth.size());
    EXPECT_NEAR(spikes.back(), truth.back(), 1e-3 * truth.back());
}

TEST(InTimeLoop, ItsSpikesComeNearerWithTheTolerance) {
    const auto loop = TransientRunner::from_file(loops + "loop.cir");
    const auto truth = true_spikes(loop, "v(s)", 0.35);
    std::vector<double> off;
    for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto spikes = loop.spike_times(loop.run(tight(reltol)), "v(s)", 0.35);
        ASSERT_EQ(spikes.size(), truth.size()) << reltol;
        off.push_back(std::abs(spikes.back() - truth.back()));
    }
    expect_falling(off, 1e-6 * truth.back(), "loop");
}

}  // namespace
}  // namespace corpuscle::circuit
