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

TransientPlan plan_with_reltol(double reltol) {
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

/// Expects an error that does not grow with any decade of reltol, and falls by a factor of thirty over three decades. (A method of second
/// order would give a hundred; quantized steps give less.)
void expect_falling(const std::vector<double>& errors, double floor, const std::string& what) {
    for (std::size_t k = 1; k < errors.size(); ++k)
        EXPECT_LT(errors[k], std::max(errors[k - 1], floor)) << what << ": at 1e-" << 3 + k << ", after " << errors[k - 1];
    EXPECT_LT(errors.back(), std::max(errors.front() / 30, floor)) << what;
    testing::Test::RecordProperty(what, testing::PrintToString(errors));
}

TEST(Ida, AgreesWithTheClosedFormOfAChargingCapacitor) {
    const auto rc = TransientRunner::from_text("rc\nv1 in 0 pwl(0 0 1m 0 1.001m 1)\nr1 in out 1k\nc1 out 0 1u\n.tran 1u 5m\n");
    IdaOptions options;
    options.crossing_unknown = rc.unknown("v(out)"), options.crossing_level = 0.5;
    options.output_times = {0.5e-3, 2e-3, 3e-3, 5e-3};
    const auto result = rc.run_ida(options);
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.x.size(), 4U);
    const auto exact = [](double t) { return 1 - 1e3 * std::expm1(1e-3) * std::exp(-(t - 1e-3) / 1e-3); };
    for (std::size_t k = 1; k < 4; ++k)
        EXPECT_NEAR(result.x[k][static_cast<std::size_t>(options.crossing_unknown)], exact(options.output_times[k]), 1e-7)
            << options.output_times[k];
    ASSERT_EQ(result.crossings.size(), 1U);
    EXPECT_NEAR(exact(result.crossings[0]), 0.5, 1e-7);
}

TEST(Ida, AgreesWithItselfOnAnOscillatorsSpikes) {
    const auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    IdaOptions options;
    options.crossing_unknown = oscillator.unknown("v(s)"), options.crossing_level = 0.35;
    options.reltol = options.vntol = 1e-8;
    const auto loose = oscillator.run_ida(options);
    options.reltol = options.vntol = 1e-10;
    const auto precise = oscillator.run_ida(options);
    ASSERT_EQ(loose.crossings.size(), precise.crossings.size());
    for (std::size_t k = 0; k < precise.crossings.size(); ++k)
        EXPECT_NEAR(loose.crossings[k], precise.crossings[k], 1e-6 * precise.crossings[k]) << k;
    EXPECT_LT(variation(intervals({precise.crossings.begin() + 2, precise.crossings.end()})), 1e-7);
}

TEST(IdaOrder, ErrorsOfAFilterFallWithTheTolerance) {
    for (const auto* waveform : {"pwl(0 0.35 10m 0.35 11m 0.38)", "sin(0.35 0.03 20)"}) {
        const auto filter = high_pass(waveform, "0.2");
        std::vector<TransientPoints> runs;
        for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) runs.push_back(filter.run(plan_with_reltol(reltol)));
        expect_falling(distances(filter, runs, "v(hpb)"), 1e-8, waveform);
    }
}

/// The first steps are of first order; at 0.1 s, where the comparison starts, their error has decayed.
TEST(IdaOrder, ErrorsOfAFilterFallWithTheStepByTheOrder) {
    const auto filter = high_pass("sin(0.35 0.03 40)", "0.2");
    for (const auto& rule : {bdf[0], bdf[1], bdf[2], bdf[3], trapezoidal}) {
        const double coarse = rule.order > 3 ? 1e-3 : rule.order > 2 ? 400e-6 : 100e-6;
        std::vector<TransientPoints> runs;
        for (const double h : {coarse, coarse / 2, coarse / 4}) runs.push_back(filter.run(equal_steps(h, rule)));
        const auto errors = distances(filter, runs, "v(hpb)", 0.1);
        for (std::size_t k = 1; k < errors.size(); ++k)
            EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), rule.order, 0.2)
                << rule.name << ": " << errors[k - 1] << " V, then " << errors[k];
    }
}

TEST(IdaOrder, AnOscillatorsSpikesConvergeWithTheTolerance) {
    auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    oscillator.set_stop_time(0.4);
    const auto reference = reference_spikes(oscillator, "v(s)", 0.35);
    ASSERT_GT(reference.size(), 8U);
    std::vector<double> errors;
    for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto spikes = oscillator.spike_times(oscillator.run(plan_with_reltol(reltol)), "v(s)", 0.35);
        ASSERT_EQ(spikes.size(), reference.size()) << reltol;
        errors.push_back(std::abs(spikes.back() - reference.back()));
    }
    expect_falling(errors, 1e-6 * reference.back(), "oscillator");
}

/// Equal steps cannot resolve a Schmitt trigger's edges, which take nanoseconds, but they resolve the waves of a ring oscillator.
TEST(IdaOrder, AHalvedStepQuartersTheErrorOfARingsPeriod) {
    const auto ring = TransientRunner::from_file(loops + "ring.cir");
    const auto reference = reference_spikes(ring, "v(a)", 0.35);
    ASSERT_GT(reference.size(), 3U);
    for (const auto& rule : {bdf[1], trapezoidal}) {
        std::vector<double> errors;
        for (const double h : {0.8e-9, 0.4e-9, 0.2e-9}) {
            const auto rises = ring.spike_times(ring.run(equal_steps(h, rule)), "v(a)", 0.35);
            ASSERT_EQ(rises.size(), reference.size()) << h;
            errors.push_back(std::abs(rises.back() - reference.back()));
        }
        for (std::size_t k = 1; k < errors.size(); ++k)
            EXPECT_NEAR(errors[k - 1] / errors[k], 4, 0.5) << rule.name << ": " << errors[k - 1] << " s, then " << errors[k];
    }
}

TEST(IdaDefaults, AnOscillatorKeepsItsPeriodForASecond) {
    const auto oscillator = TransientRunner::from_text(oscillator_netlist("1"));
    const auto reference = reference_spikes(oscillator, "v(s)", 0.35);
    const auto spikes = oscillator.spike_times(oscillator.run({}), "v(s)", 0.35);
    ASSERT_EQ(spikes.size(), reference.size());
    const auto own_intervals = intervals(spikes), reference_intervals = intervals(reference);
    double worst = 0;
    for (std::size_t k = 0; k < own_intervals.size(); ++k) worst = std::max(worst, std::abs(own_intervals[k] / reference_intervals[k] - 1));
    EXPECT_LT(worst, 1e-3) << "the worst interval";
    EXPECT_LT(variation({own_intervals.begin() + 1, own_intervals.end()}), 1e-4);
    EXPECT_NEAR(spikes.back(), reference.back(), 1e-3 * reference.back());
}

TEST(IdaLoop, LastSpikeIsWithinAThousandthAtDefaultTolerances) {
    const auto loop = TransientRunner::from_file(loops + "loop.cir");
    const auto reference = reference_spikes(loop, "v(s)", 0.35);
    ASSERT_GT(reference.size(), 20U);
    const auto spikes = loop.spike_times(loop.run({}), "v(s)", 0.35);
    ASSERT_EQ(spikes.size(), reference.size());
    EXPECT_NEAR(spikes.back(), reference.back(), 1e-3 * reference.back());
}

TEST(IdaLoop, SpikesConvergeWithTheTolerance) {
    const auto loop = TransientRunner::from_file(loops + "loop.cir");
    const auto reference = reference_spikes(loop, "v(s)", 0.35);
    std::vector<double> errors;
    for (const double reltol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto spikes = loop.spike_times(loop.run(plan_with_reltol(reltol)), "v(s)", 0.35);
        ASSERT_EQ(spikes.size(), reference.size()) << reltol;
        errors.push_back(std::abs(spikes.back() - reference.back()));
    }
    expect_falling(errors, 1e-6 * reference.back(), "loop");
}

}  // namespace
}  // namespace corpuscle::circuit
