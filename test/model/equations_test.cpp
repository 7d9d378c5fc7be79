// The equations as text, from which models for other simulators are written, are those that the simulation computes.

#include "model/equations/afferent_equations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/catalog.hpp"
#include "model/equation_runner.hpp"

namespace corpuscle {
namespace {

constexpr double dt = 1e-5;  // s

/// A touch with an edge, a hold, a vibration and a release, N.
std::vector<double> touch(double scale) {
    std::vector<double> force(12001);
    for (std::size_t k = 0; k < force.size(); ++k) {
        const double t = static_cast<double>(k) * dt;
        force[k] = scale * (0.1 + std::clamp(std::min((t - 0.01) / 0.03, (0.1 - t) / 0.015), 0.0, 1.0) +
                            0.02 * std::sin(2 * 3.141592653589793 * 60 * t) * (t > 0.04 && t < 0.08));
    }
    return force;
}

/// A plan of the afferent in which each parameter differs from its default, so that each is seen. No jitter.
AfferentPlan changed_plan(const std::string& name) {
    auto plan = *plan_afferent(name);
    for (std::size_t k = 0; k < plan.values.size(); ++k) {
        const auto& row = (*plan.parameters)[k].info;
        auto value = plan.values[k] * 1.07;
        if (plan.values[k] == 0) value = row.unit == "s" ? 2e-3 : row.unit == "V" ? 0.01 : row.unit == "A" ? 1e-7 : 0.3;
        if (row.name == "jitter") value = 0;
        if (row.name == "substep") value = plan.values[k];
        plan.values[k] = std::clamp(value, row.low, row.high);
    }
    EXPECT_TRUE(check_plan(plan)) << name;
    return plan;
}

/// The spikes (s), and the probes whose name begins with I_ or is I.
struct Simulated {
    std::vector<double> spikes;
    std::vector<std::vector<double>> currents;
};
Simulated simulate_plan(const AfferentPlan& plan, const std::vector<double>& force, std::size_t currents) {
    const auto afferent = make_afferent(plan, {.dt = dt});
    std::vector<std::vector<double>> probes(afferent->probes().size(), std::vector<double>(force.size()));
    std::vector<double*> pointers;
    for (auto& p : probes) pointers.push_back(p.data());
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    response.probes = pointers;
    auto state = afferent->start();
    EXPECT_TRUE(afferent->respond(force, state, response));
    Simulated out;
    for (const auto& s : spikes) out.spikes.push_back((static_cast<double>(s.step) - 1 + s.offset) * dt);
    for (std::size_t k = 0; k < probes.size(); ++k) {
        const auto name = afferent->probes()[k].name;
        if (name == "I" || (currents == 2 && name.starts_with("I_"))) out.currents.push_back(probes[k]);
    }
    return out;
}

double largest(const std::vector<double>& x) {
    double m = 0;
    for (const double v : x) m = std::max(m, std::abs(v));
    return m;
}

TEST(Equations, EveryReceptorAndNeuronOfTheCatalogueHasThem) {
    const auto has = [](const auto& rows, std::string_view name) {
        return std::any_of(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
    };
    for (const auto& entry : receptor_entries()) EXPECT_TRUE(has(all_receptor_equations(), entry.name)) << entry.name;
    for (const auto& entry : neuron_entries()) EXPECT_TRUE(has(all_neuron_equations(), entry.name)) << entry.name;
}

TEST(Equations, EveryParameterIsUsedOrIsNumerical) {
    for (const auto& r : receptor_entries())
        for (const auto& n : neuron_entries()) {
            const auto plan = changed_plan(fmt::format("{}+{}", r.name, n.name));
            const auto equations = equations_of(plan);
            ASSERT_TRUE(equations) << equations.error().message;
            for (const auto& p : *plan.parameters) {
                const bool used = std::any_of(equations->parameters.begin(), equations->parameters.end(),
                                              [&](const auto& u) { return u.name == p.info.name; });
                EXPECT_EQ(used, p.info.name != "substep" && p.info.name != "jitter") << plan.name << ' ' << p.info.name;
            }
        }
}

TEST(Equations, GiveTheCurrentsOfEveryReceptor) {
    for (const auto& entry : receptor_entries()) {
        const auto plan = changed_plan(fmt::format("{}+lif-b", entry.name));
        const auto equations = *equations_of(plan);
        const auto force = touch(1);
        const auto text = test::run_equations(equations, force, dt);
        const auto code = simulate_plan(plan, force, equations.receptor->currents.size());
        ASSERT_EQ(text.currents.size(), code.currents.size()) << plan.name;
        for (std::size_t c = 0; c < text.currents.size(); ++c) {
            const double scale = largest(code.currents[c]);
            EXPECT_GT(scale, 0) << plan.name;
            double difference = 0;
            // The slope jumps at samples, so a current that follows it is that of the step before or after.
            for (std::size_t k = 1; k < force.size(); ++k)
                difference = std::max(difference, std::abs(text.currents[c][k] - code.currents[c][k]));
            EXPECT_LT(difference, 1e-3 * scale) << plan.name << " current " << c;
        }
    }
}

TEST(Equations, GiveTheSpikesOfEveryNeuron) {
    for (const std::string receptor : {"sa1b", "fa1a"})
        for (const auto& entry : neuron_entries()) {
            const auto plan = changed_plan(fmt::format("{}+{}", receptor, entry.name));
            const auto equations = *equations_of(plan);
            const bool has_high_gain = entry.name == "izhikevich" || entry.name == "adex";
            const auto force = touch(receptor == "fa1a" && !has_high_gain ? 40 : 4);
            const auto text = test::run_equations(equations, force, dt).spikes;
            const auto code = simulate_plan(plan, force, equations.receptor->currents.size()).spikes;
            EXPECT_GT(code.size(), 3U) << plan.name;
            ASSERT_EQ(text.size(), code.size()) << plan.name;
            for (std::size_t k = 0; k < text.size(); ++k) EXPECT_NEAR(text[k], code[k], 2 * dt) << plan.name << " spike " << k;
        }
}

TEST(Equations, AfferentsThatTheyDoNotDescribeAreRefusedWithAReasonAndARemedy) {
    const auto message = [](const std::string& name) {
        const auto equations = equations_of(*plan_afferent(name));
        return equations ? "" : equations.error().message;
    };
    EXPECT_EQ(message("sa1-kim"),
              "sa1-kim: cannot be exported as equations: behind the converter 'adc' it computes in fixed point; export 'sa1a+lif-a'");
    EXPECT_EQ(message("fsr+f2i+sa1"),
              "fsr+f2i+sa1: cannot be exported as equations: its front end (f2i) has no equations in time; export 'sa1b+lif-b'");
    EXPECT_EQ(message("sa1-nerve"),
              "sa1-nerve: cannot be exported as equations: its threshold is random (jitter = 0.33); add --set sa1-nerve.jitter=0");
}

}  // namespace
}  // namespace corpuscle
