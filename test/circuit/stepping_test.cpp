// The steps of a transient: interpolation polynomials, order, stop and resume, initial conditions.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "circuit/analysis/transient_setup.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/oscillator.hpp"
#include "core/number/instruction_set.hpp"

namespace corpuscle::circuit {
namespace {

/// Points of x = t^3 - 2 t + 1.
History cubic_past() {
    History past;
    for (const double t : {0.0, 0.5, 0.7, 1.5, 1.6}) {
        auto& next = past.next_point();
        next.t = t, next.x = {t * t * t - 2 * t + 1}, next.q = {0};
        past.accept();
    }
    return past;
}

TEST(History, ReproducesAPolynomialOfItsDegree) {
    const History past = cubic_past();
    double value = 0;
    past.combine(past.value_weights(2.5, 4), 4, &TimePoint::x, {&value, 1});
    EXPECT_NEAR(value, 2.5 * 2.5 * 2.5 - 2 * 2.5 + 1, 1e-12);
    double leading = 0, slope = 0;
    const auto weights = past.slope_weights(2.0, 3, leading);
    past.combine(weights, 3, &TimePoint::x, {&slope, 1});
    EXPECT_NEAR(slope + leading * 5.0, 3 * 4.0 - 2, 1e-12);
}

TEST(History, KeepsTheNewestPoints) {
    History past;
    for (int k = 0; k < 30; ++k) past.next_point().t = k, past.next_point().x = {0}, past.next_point().q = {0}, past.accept();
    EXPECT_EQ(past.count(), History::max_points);
    for (int k = 0; k < past.count(); ++k) EXPECT_EQ(past[k].t, 29 - k);
}

/// A circuit with its transient plan.
struct TransientFixture {
    std::unique_ptr<AnalysisContext> context;
    TransientPlan plan;
    TransientFixture(const std::string& netlist, double stop) {
        auto made = AnalysisContext::make(make_circuit(netlist));
        EXPECT_TRUE(made) << made.error().text();
        context = std::move(*made);
        plan.stop = stop, plan.max_step = stop / 50;
        context->system.start_transient(stop / 1000, stop);
    }
    std::unique_ptr<Transient> started_transient() {
        auto out = std::make_unique<Transient>(context->system, context->newton, plan);
        const auto from = find_initial_condition(*context, false);
        EXPECT_TRUE(from) << from.error().text();
        EXPECT_TRUE(out->begin(from->x, from->is_consistent));
        return out;
    }
};

const std::string membrane = oscillator_netlist("0.2");

TEST(Transient, ResumesFromASavedStateWithTheSameResult) {
    TransientFixture one(membrane, 0.2), other(membrane, 0.2);
    auto continuous = one.started_transient();
    std::vector<double> saved;
    for (int k = 0; k < 2000; ++k) {
        ASSERT_TRUE(continuous->step(0.2));
        if (k != 700) continue;
        StateArchive writer(saved);
        continuous->archive(writer);
    }
    auto resumed = other.started_transient();
    StateArchive reader{std::span<const double>(saved)};
    resumed->archive(reader);
    EXPECT_TRUE(reader.is_valid);
    for (int k = 701; k < 2000; ++k) ASSERT_TRUE(resumed->step(0.2));
    EXPECT_EQ(resumed->time(), continuous->time());
    for (std::size_t n = 0; n < continuous->x().size(); ++n) EXPECT_EQ(resumed->x()[n], continuous->x()[n]) << n;
    EXPECT_EQ(resumed->stats().iterations, continuous->stats().iterations);
}

TEST(Transient, GivesTheSameBitsOnLanesOfAnyWidth) {
    std::vector<std::vector<double>> ends;
    for (const auto set : instruction_sets()) {
        setenv("CORPUSCLE_ISA", std::string(name_of(set)).c_str(), 1);
        TransientFixture one(membrane, 0.1);
        auto t = one.started_transient();
        while (t->time() < 0.1) ASSERT_TRUE(t->step(0.1));
        ends.emplace_back(t->x().begin(), t->x().end());
        ends.back().push_back(static_cast<double>(t->stats().steps));
        EXPECT_EQ(ends.back(), ends.front()) << name_of(set);
    }
    unsetenv("CORPUSCLE_ISA");
    EXPECT_GT(ends.size(), 1U);
}

TEST(Transient, TakesTheSameStepsForAnyBlockLength) {
    TransientFixture one(membrane, 0.1), other(membrane, 0.1);
    auto continuous = one.started_transient(), pieces = other.started_transient();
    std::vector<double> continuous_times, piece_times;
    while (continuous->time() < 0.1) {
        ASSERT_TRUE(continuous->step(0.1));
        continuous_times.push_back(continuous->time());
    }
    for (double until = 0; pieces->time() < 0.1; until += 0.00037)
        for (bool more = true; more && pieces->time() < 0.1;) {
            const auto stepped = pieces->step(std::min(until, 0.1));
            ASSERT_TRUE(stepped);
            more = *stepped;
            if (more) piece_times.push_back(pieces->time());
        }
    EXPECT_GT(continuous_times.size(), 500U);
    EXPECT_EQ(piece_times, continuous_times);
}

TEST(Transient, FindsWhereALevelIsCrossedWithinAStep) {
    TransientFixture sine("sine\nv1 a 0 sin(0 1 50)\nr1 a b 1k\nc1 b 0 1n\n.tran 1u 0.1\n", 0.1);
    sine.plan.max_step = 1e-3;
    auto t = sine.started_transient();
    const int node = sine.context->system.unknown("v(a)");
    std::vector<double> up, down;
    while (t->time() < 0.1) {
        ASSERT_TRUE(t->step(0.1));
        if (const auto at = t->crossing(node, -1, 0.5, true)) up.push_back(*at);
        if (const auto at = t->crossing(node, -1, 0.5, false)) down.push_back(*at);
    }
    ASSERT_EQ(up.size(), 5U);
    ASSERT_EQ(down.size(), 5U);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(up[k], (static_cast<double>(k) + 1.0 / 12) / 50, 2e-6);
        EXPECT_NEAR(down[k], (static_cast<double>(k) + 5.0 / 12) / 50, 2e-6);
    }
}

TEST(Transient, ReportsTheErrorOfItsSpikeTimes) {
    const auto spiking = [](const std::string& options) {
        return run_netlist(oscillator_netlist("0.3") + ".spike v(s) 0.35\n.options " + options + "\n");
    };
    const auto truth = spiking("accuracy=finest spikecheck=0");
    for (const auto* options : {"reltol=3e-4", "reltol=1e-4", "accuracy=normal", "accuracy=fine"}) {
        const auto run = spiking(options);
        ASSERT_EQ(run.number("spikes"), truth.number("spikes")) << options;
        const double error = std::abs(run.number("last_spike") - truth.number("last_spike"));
        EXPECT_LE(error, run.number("spike_error")) << options;
        EXPECT_LE(run.number("spike_error"), 100 * error + 1e-6) << options;
    }
    for (const auto& [name, value] : truth.numbers()) EXPECT_NE(name, "spike_error") << value;
}

TEST(Transient, WithoutAnInitialConditionAnOscillatorIsPerturbedAndReported) {
    auto free = membrane;
    free.erase(free.find(".ic"), free.find('\n', free.find(".ic")) - free.find(".ic") + 1);
    const auto run = run_netlist(free);
    const auto s = run.curve("v(s)");
    EXPECT_GT(std::count_if(s.begin() + 1, s.end(), [](double v) { return v > 0.35; }), 100);
    ASSERT_FALSE(run.warnings().empty());
    EXPECT_NE(run.warnings().back().message.find("the operating point is unstable"), std::string::npos);
}

TEST(Transient, ARestingCircuitStaysAtRest) {
    for (const char* netlist :
         {"divider\nv1 a 0 1\nr1 a b 1k\nr2 b 0 1k\nc1 b 0 1u\nd1 b 0 d\n.model d d\n.tran 1m 1\n",
          "inverter\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\nm1 o i vdd vdd pch w=6u l=0.5u\nm2 o i 0 0 nch w=1.5u l=0.5u\n"
          "vi i 0 0.3\n.tran 1m 1\n"}) {
        const auto run = run_netlist(netlist);
        EXPECT_TRUE(run.warnings().empty()) << run.warnings()[0].text();
        for (const auto& curve : run.analyses()[0].result.plots[0].curves)
            if (curve.name != "time") {
                EXPECT_NEAR(std::abs(curve.values.front() - curve.values.back()), 0, 1e-9) << curve.name;
            }
    }
}

TEST(Transient, WithUicNodesWithoutChargeAreSolved) {
    const auto run = run_netlist("uic\nv1 a 0 1\nr1 a b 1k\nr2 b c 1k\nc1 c 0 1u\n.ic v(c)=0.4\n.tran 1u 10u uic\n");
    EXPECT_NEAR(run.curve("v(a)")[0], 1, 1e-9);
    EXPECT_NEAR(run.curve("v(b)")[0], 0.7, 1e-9);
    EXPECT_NEAR(run.curve("v(c)")[0], 0.4, 1e-6);
}

/// The ramp of an expression starts without a breakpoint. With a plain trapezoidal rule, the current of a capacitor on it would oscillate
/// forever.
TEST(Transient, TheTrapezoidalRuleDoesNotKeepRinging) {
    for (const auto method : {Integration::trapezoidal, Integration::bdf}) {
        TransientFixture ramp("ramp\nb1 a 0 v=uramp(time-10.0303m)\nc1 a 0 1n\n.end\n", 0.02);
        ramp.plan.max_step = 1e-4, ramp.plan.reltol = 1, ramp.plan.vntol = 1;  // steps of the maximum length
        ramp.plan.method = method;
        auto t = ramp.started_transient();
        double error = 0;
        while (t->time() < 0.02) {
            ASSERT_TRUE(t->step(0.02));
            if (t->time() > 11e-3) error = std::max(error, std::abs(t->x()[1] + 1e-9));
        }
        EXPECT_LT(error, 1e-12) << (method == Integration::bdf ? "BDF" : "trapezoidal");
    }
}

TEST(TransientPlan, RejectsUnknownValues) {
    for (const auto& [options, what] :
         {std::pair{"accuracy=great", "rough, normal, fine, finest"}, {"method=heun", "gear, trap, euler"}, {"maxord=7", "from 1 to 5"}}) {
        const auto plan = read_transient_plan(*make_circuit(std::string("x\nr1 a 0 1\nv1 a 0 1\n.options ") + options + "\n.tran 1 2\n"));
        ASSERT_FALSE(plan);
        EXPECT_NE(plan.error().message.find(what), std::string::npos) << plan.error().message;
    }
}

/// The result of a line of resistors, coils and capacitors whose own oscillations are far faster than its source.
NetlistRun run_of_line(const std::string& options) {
    std::string text = "line\n.options " + options + "\nv1 n0 0 sin(0 1 60)\n";
    for (int k = 0; k < 300; ++k) text += fmt::format("r{0} n{0} m{0} 10\nl{0} m{0} n{1} 1n\nc{0} n{1} 0 1p\n", k, k + 1);
    return run_netlist(text + ".tran 1m 50m\n.save v(n300)\n");
}

TEST(Order, IsLoweredWhereHigherOrdersAreUnstable) {
    const auto run = run_of_line("accuracy=normal");
    const auto& stats = run.analyses()[0].result.stats;
    const auto steps = std::ranges::find(stats, "steps", &std::pair<std::string, double>::first);
    ASSERT_NE(steps, stats.end());
    EXPECT_LT(steps->second, 3000) << "58,000 where the order stays at 3 and 4";
    const auto t = run.curve("time"), v = run.curve("v(n300)");
    for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(v[k], std::sin(2 * std::numbers::pi * 60 * t[k]), 2e-4) << t[k];
}

}  // namespace
}  // namespace corpuscle::circuit
