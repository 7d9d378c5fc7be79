// Transients compared with IDA of SUNDIALS on the same equations: size of the error, and its decrease with the tolerance and the step.

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "circuit/oscillator.hpp"
#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {
namespace {

const std::string loops = test::source_root() + "/test/circuit/loops/";

/// The thesis's high-pass filters with another input waveform and duration.
TransientRunner high_pass(const std::string& waveform, const std::string& stop) {
    return TransientRunner::from_file(test::source_root() + "/circuits/high_pass.cir",
                                      {{"vf ", "vf vf 0 " + waveform}, {".ac", ".tran 1u " + stop}});
}

/// For each run, the largest difference (V) of an unknown from IDA's result, at the run's own points after `from` (s).
std::vector<double> distances(const TransientRunner& circuit, const std::vector<TransientPoints>& runs, const std::string& name,
                              double from = 0) {
    IdaOptions options;
    for (const auto& run : runs) options.output_times.insert(options.output_times.end(), run.t.begin(), run.t.end());
    std::sort(options.output_times.begin(), options.output_times.end());
    options.output_times.erase(std::unique(options.output_times.begin(), options.output_times.end()), options.output_times.end());
    options.reltol = options.vntol = 1e-10;
    const auto reference = circuit.run_ida(options);
    EXPECT_EQ(reference.error, "");
    std::vector<double> out;
    const auto u = static_cast<std::size_t>(circuit.unknown(name));
    for (const auto& run : runs) {
        EXPECT_EQ(run.error, "");
        double worst = 0;
        for (std::size_t k = 0; k < run.t.size(); ++k) {
            const auto at =
                std::lower_bound(options.output_times.begin(), options.output_times.end(), run.t[k]) - options.output_times.begin();
            if (run.t[k] > from && static_cast<std::size_t>(at) < reference.x.size())
                worst = std::max(worst, std::abs(run.x[k][u] - reference.x[static_cast<std::size_t>(at)][u]));
        }
        out.push_back(worst);
    }
    return out;
}

std::vector<double> reference_spikes(const TransientRunner& circuit, const std::string& name, double level) {
    IdaOptions options;
    options.crossing_unknown = circuit.unknown(name), options.crossing_level = level, options.reltol = options.vntol = 1e-9;
    const auto reference = circuit.run_ida(options);
    EXPECT_EQ(reference.error, "");
    return reference.crossings;
}

std::vector<double> intervals(const std::vector<double>& spikes) {
    std::vector<double> out;
    for (std::size_t k = 1; k < spikes.size(); ++k) out.push_back(spikes[k] - spikes[k - 1]);
    return out;
}

/// Coefficient of variation.
double variation(const std::vector<double>& x) {
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

/// Equal steps of length `step` (s), regardless of their error.
TransientPlan equal_steps(double step, const Rule& rule) {
    TransientPlan plan;
    plan.reltol = 1e9, plan.max_step = step, plan.method = rule.method, plan.max_order = rule.order;
    return plan;
}

/// The error must not grow with any decade of reltol, and must fall by a factor of thirty over three decades (second order: a hundred, less
/// because steps are quantized).
void expect_falling(const std::vector<double>& off, double floor, const std::string& what) {
    for (std::size_t k = 1; k < off.size(); ++k)
        EXPECT_LT(off[k], std::max(off[k - 1], floor)) << what << ": at 1e-" << 3 + k << ", after " << off[k - 1];
    EXPECT_LT(off.back(), std::max(off.front() / 30, floor)) << what;
    testing::Test::RecordProperty(what, testing::PrintToString(off));
}

TEST(Ida, AgreesWithTheClosedFormOfAChargingCapacitor) {
    const auto rc = TransientRunner::from_text("rc\nv1 in 0 pwl(0 0 1m 0 1.001m 1)\nr1 in out 1k\nc1 out 0 1u\n.tran 1u 5m\n");
    IdaOptions options;
    options.crossing_unknown = rc.unknown("v(out)"), options.crossing_level = 0.5;
    options.output_times = {0.5e-3, 2e-3, 3e-3, 5e-3};
    const auto found = rc.run_ida(options);
    ASSERT_EQ(found.error, "");
    ASSERT_EQ(found.x.size(), 4U);
    const auto exact = [](double t) { return 1 - 1e3 * std::expm1(1e-3) * std::exp(-(t - 1e-3) / 1e-3); };
    for (std::size_t k = 1; k < 4; ++k)
        EXPECT_NEAR(found.x[k][static_cast<std::size_t>(options.crossing_unknown)], exact(options.output_times[k]), 1e-7)
            << options.output_times[k];
    ASSERT_EQ(found.crossings.size(), 1U);
    EXPECT_NEAR(exact(found.crossings[0]), 0.5, 1e-7);
}

TEST(Ida, AgreesWithItselfOnAnOscillatorsSpikes) {
    const auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    IdaOptions options;
    options.crossing_unknown = oscillator.unknown("v(s)"), options.crossing_level = 0.35;
    options.reltol = options.vntol = 1e-8;
    const auto loose = oscillator.run_ida(options);
    options.reltol = options.vntol = 1e-10;
    const auto close = oscillator.run_ida(options);
    ASSERT_EQ(loose.crossings.size(), close.crossings.size());
    for (std::size_t k = 0; k < close.crossings.size(); ++k)
        EXPECT_NEAR(loose.crossings[k], close.crossings[k], 1e-6 * close.crossings[k]) << k;
    EXPECT_LT(variation(intervals({close.crossings.begin() + 2, close.crossings.end()})), 1e-7);
}

TEST(IdaOrder, ErrorsOfAFilterFallWithTheTolerance) {
    for (const auto* waveform : {"pwl(0 0.35 10m 0.35 11m 0.38)", "sin(0.35 0.03 20)"}) {
        const auto filter = high_pass(waveform, "0.2");
        std::vector<TransientPoints> runs;
        for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) runs.push_back(filter.run(tight(reltol)));
        expect_falling(distances(filter, runs, "v(hpb)"), 1e-8, waveform);
    }
}

/// The first steps are of first order; their error has decayed when the comparison starts.
TEST(IdaOrder, ErrorsOfAFilterFallWithTheStepByTheOrder) {
    const auto filter = high_pass("sin(0.35 0.03 40)", "0.2");
    for (const auto& rule : {bdf[0], bdf[1], bdf[2], bdf[3], trapezoidal}) {
        const double coarse = rule.order > 3 ? 1e-3 : rule.order > 2 ? 400e-6 : 100e-6;
        std::vector<TransientPoints> runs;
        for (const double h : {coarse, coarse / 2, coarse / 4}) runs.push_back(filter.run(equal_steps(h, rule)));
        const auto off = distances(filter, runs, "v(hpb)", 0.1);
        for (std::size_t k = 1; k < off.size(); ++k)
            EXPECT_NEAR(std::log2(off[k - 1] / off[k]), rule.order, 0.2) << rule.name << ": " << off[k - 1] << " V, then " << off[k];
    }
}

TEST(IdaOrder, AnOscillatorsSpikesConvergeWithTheTolerance) {
    auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    oscillator.set_stop_time(0.4);
    const auto reference = reference_spikes(oscillator, "v(s)", 0.35);
    ASSERT_GT(reference.size(), 8U);
    std::vector<double> off;
    for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto spikes = oscillator.spike_times(oscillator.run(tight(reltol)), "v(s)", 0.35);
        ASSERT_EQ(spikes.size(), reference.size()) << reltol;
        off.push_back(std::abs(spikes.back() - reference.back()));
    }
    expect_falling(off, 1e-6 * reference.back(), "oscillator");
}

/// A Schmitt trigger's edge takes nanoseconds, so equal steps show no order there. They resolve the waves of a ring oscillator.
TEST(IdaOrder, ARingsPeriodErrorFallsFourfoldWithHalfTheStep) {
    const auto ring = TransientRunner::from_file(loops + "ring.cir");
    const auto reference = reference_spikes(ring, "v(a)", 0.35);
    ASSERT_GT(reference.size(), 3U);
    for (const auto& rule : {bdf[1], trapezoidal}) {
        std::vector<double> off;
        for (const double h : {0.8e-9, 0.4e-9, 0.2e-9}) {
            const auto rises = ring.spike_times(ring.run(equal_steps(h, rule)), "v(a)", 0.35);
            ASSERT_EQ(rises.size(), reference.size()) << h;
            off.push_back(std::abs(rises.back() - reference.back()));
        }
        for (std::size_t k = 1; k < off.size(); ++k)
            EXPECT_NEAR(off[k - 1] / off[k], 4, 0.5) << rule.name << ": " << off[k - 1] << " s, then " << off[k];
    }
}

TEST(IdaDefaults, AnOscillatorKeepsItsPeriodForASecond) {
    const auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    const auto reference = reference_spikes(oscillator, "v(s)", 0.35);
    const auto spikes = oscillator.spike_times(oscillator.run({}), "v(s)", 0.35);
    ASSERT_EQ(spikes.size(), reference.size());
    const auto mine = intervals(spikes), theirs = intervals(reference);
    double worst = 0;
    for (std::size_t k = 0; k < mine.size(); ++k) worst = std::max(worst, std::abs(mine[k] / theirs[k] - 1));
    EXPECT_LT(worst, 1e-3) << "the worst interval";
    EXPECT_LT(variation({mine.begin() + 1, mine.end()}), 1e-4);
    EXPECT_NEAR(spikes.back(), reference.back(), 1e-3 * reference.back());
}

TEST(IdaLoop, ItsLastSpikeStaysWithinAThousandthAtDefaults) {
    const auto loop = TransientRunner::from_file(loops + "loop.cir");
    const auto reference = reference_spikes(loop, "v(s)", 0.35);
    ASSERT_GT(reference.size(), 20U);
    const auto spikes = loop.spike_times(loop.run({}), "v(s)", 0.35);
    ASSERT_EQ(spikes.size(), reference.size());
    EXPECT_NEAR(spikes.back(), reference.back(), 1e-3 * reference.back());
}

TEST(IdaLoop, ItsSpikesConvergeWithTheTolerance) {
    const auto loop = TransientRunner::from_file(loops + "loop.cir");
    const auto reference = reference_spikes(loop, "v(s)", 0.35);
    std::vector<double> off;
    for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto spikes = loop.spike_times(loop.run(tight(reltol)), "v(s)", 0.35);
        ASSERT_EQ(spikes.size(), reference.size()) << reltol;
        off.push_back(std::abs(spikes.back() - reference.back()));
    }
    expect_falling(off, 1e-6 * reference.back(), "loop");
}

}  // namespace
}  // namespace corpuscle::circuit
