// Afferents with several forces on SIMD lanes: each force has a receptor of its own, and the mean of their currents drives the neuron.

#include <fmt/format.h>
#include <cmath>

#include "core/random.hpp"
#include "model/copies.hpp"
#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"
#include "model/models.hpp"
#include "model/parameter_values.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

constexpr std::size_t samples = 2500;  // more than two flushes

/// Copies of an afferent with different parameters, and `forces` arrays of force for each.
struct ForcesCase {
    std::vector<AfferentPlan> plans;
    std::size_t forces, afferents;
    SimulationOptions run{1e-3};
    std::vector<std::vector<double>> force;  // [afferent][force], N

    ForcesCase(const std::string& name, std::size_t forces, Method method, std::size_t afferents = 70)
        : forces(forces), afferents(afferents) {
        run.method = method;
        const auto plan = value_or_throw(plan_afferent(name));
        std::vector<ParameterOverride> spreads;
        for (std::size_t k = 0; k < plan.values.size(); ++k)
            if (const auto& row = (*plan.parameters)[k].info; !row.is_shared_by_copies && plan.values[k] != 0)
                spreads.push_back({name, std::string(row.name), "2%"});
        plans = value_or_throw(
            make_copies(plan, static_cast<std::uint32_t>(afferents), test::applied_or_throw(distributions_for(plan, spreads)), 5));
        for (std::uint32_t k = 0; k < afferents * forces; ++k) {
            std::vector<double> f(samples);
            const double period = 20 + 50 * std::abs(normal(1, k, 0, 0)), phase = normal(1, k, 0, 1);
            for (std::size_t t = 0; t < samples; ++t)  // no force in the last fifth
                f[t] = t < samples * 4 / 5 ? 2 * std::max(0.0, std::sin(static_cast<double>(t) / period + phase)) : 0;
            force.push_back(std::move(f));
        }
    }
};

/// The afferent with receptor R and neuron N, written as one plain loop.
template <template <class> class R, template <class> class N>
void simulate_by_hand(const ForcesCase& c, std::uint32_t u, std::vector<Spike>& out) {
    using Receptor = R<double>;
    using Neuron = N<double>;
    constexpr int outputs = Receptor::outputs;
    const Receptor receptor(ParameterValues<Receptor>(c.plans[u]), c.run.dt, c.run.method);
    const Neuron neuron(ParameterValues<Neuron>(c.plans[u]), c.run.dt, c.run.method);
    std::vector<typename Receptor::State> states;
    for (std::size_t h = 0; h < c.forces; ++h) states.push_back(receptor.start(c.force[u * c.forces + h][0]));
    typename Neuron::State neurons[outputs];
    for (auto& n : neurons) n = neuron.start();
    for (std::size_t t = 0; t < samples; ++t) {
        if (t > 0 && t % flush_interval == 0) {
            if constexpr (requires { receptor.flush_decayed(states[0]); })
                for (auto& s : states) receptor.flush_decayed(s);
            if constexpr (requires { neuron.flush_decayed(neurons[0]); })
                for (auto& n : neurons) neuron.flush_decayed(n);
        }
        Current<double> sum[outputs] = {};
        for (std::size_t h = 0; h < c.forces; ++h) {
            Current<double> i[outputs];
            receptor.step(states[h], c.force[u * c.forces + h][t], i);
            for (int k = 0; k < outputs; ++k) sum[k] = {sum[k].from + i[k].from, sum[k].to + i[k].to};
        }
        if (t == 0 && c.run.method == Method::exact) continue;
        const double factor = 1.0 / static_cast<double>(c.forces);
        for (int k = 0; k < outputs; ++k) {
            const Current<double> mean{sum[k].from * factor, sum[k].to * factor};
            neuron.step(neurons[k], mean, [&](bool, double offset) {
                out.push_back({static_cast<std::int64_t>(t), t == 0 ? 1.0 : offset, u});
            });
        }
    }
}

std::vector<Spike> by_hand(const ForcesCase& c) {
    std::vector<Spike> out;
    for (std::uint32_t u = 0; u < c.afferents; ++u)
        visit_named(Receptors{}, c.plans[0].receptor, [&]<template <class> class R>(ModelTag<R>) {
            visit_named(Neurons{}, c.plans[0].neuron, [&]<template <class> class N>(ModelTag<N>) { simulate_by_hand<R, N>(c, u, out); });
        });
    std::sort(out.begin(), out.end());
    return out;
}

std::unique_ptr<LanePopulation> population(const ForcesCase& c, InstructionSet set) {
    std::vector<const AfferentPlan*> plans;
    for (const auto& p : c.plans) plans.push_back(&p);
    return value_or_throw(make_lane_population({.plans = plans, .size = c.afferents, .forces = c.forces}, c.run, set));
}

/// The spikes on lanes. After each block, the state is saved and a new population resumes from it.
std::vector<Spike> on_lanes(const ForcesCase& c, InstructionSet set, std::size_t block, unsigned threads) {
    auto p = population(c, set);
    ThreadPool pool(threads);
    std::vector<Spike> out;
    for (std::size_t at = 0; at < samples; at += block) {
        std::vector<const double*> columns;
        for (const auto& f : c.force) columns.push_back(f.data() + at);
        PopulationResponse response{&out};
        if (auto ok = p->respond(ForceColumns{columns}, std::min(block, samples - at), response, pool); !ok)
            throw std::runtime_error(ok.error().text());
        const auto saved = p->save();
        p = population(c, set);
        if (auto ok = p->resume(saved); !ok) throw std::runtime_error(ok.error().text());
    }
    return out;
}

TEST(SeveralForces, OnLanesGiveTheBitsOfReceptorsSummedByHandInEveryModel) {
    for (const auto& r : receptor_entries())
        for (const auto& n : neuron_entries())
            for (const auto method : {Method::exact, Method::backward_euler}) {
                // Few afferents for neurons that are slow.
                const ForcesCase c(fmt::format("{}+{}", r.name, n.name), 3, method, n.name == "lif-b" ? 70 : 5);
                EXPECT_EQ(
                    on_lanes(c, *instruction_set() == InstructionSet::scalar ? InstructionSet::baseline : *instruction_set(), 4096, 1),
                    by_hand(c))
                    << r.name << '+' << n.name;
            }
}

TEST(SeveralForces, GiveTheSameSpikesInAnyBlocksThreadsAndInstructionSetsAndAfterResuming) {
    for (const auto* name : {"fa1", "sa1"}) {
        const ForcesCase c(name, 4, Method::exact);
        const auto expected = by_hand(c);
        ASSERT_GT(expected.size(), 500U) << name;
        for (const auto set : instruction_sets().subspan(1))
            for (const std::size_t block : {1, 7, 33, 1000})
                EXPECT_EQ(on_lanes(c, set, block, static_cast<unsigned>(block % 3) + 1), expected) << name << block;
    }
}

TEST(SeveralForces, ThatAreEqualActAsOne) {
    ForcesCase four("fa1", 4, Method::exact), one("fa1", 1, Method::exact);
    for (std::size_t k = 0; k < four.force.size(); ++k) four.force[k] = one.force[k / 4];
    EXPECT_EQ(on_lanes(four, InstructionSet::baseline, 4096, 1), on_lanes(one, InstructionSet::baseline, 4096, 1));
}

TEST(SeveralForces, InOppositePhaseExciteWhereTheirMeanDoesNot) {
    // A grating of 2 mm over two hot spots 1 mm apart: the force on one falls as that on the other rises.
    ForcesCase two("fa1", 2, Method::exact), one("fa1", 1, Method::exact);
    for (std::size_t u = 0; u < two.afferents; ++u)
        for (std::size_t t = 0; t < samples; ++t) {
            const double wave = std::sin(static_cast<double>(t) / 8);
            two.force[2 * u][t] = 2 + 2 * wave, two.force[2 * u + 1][t] = 2 - 2 * wave, one.force[u][t] = 2;
        }
    EXPECT_TRUE(by_hand(one).empty());
    EXPECT_GT(by_hand(two).size(), 10 * two.afferents);
    EXPECT_EQ(on_lanes(two, InstructionSet::baseline, 4096, 1), by_hand(two));
}

TEST(SeveralForces, InTilesAreSkippedWithoutForceAndGiveTheSameSpikes) {
    const ForcesCase c("fa1", 3, Method::exact);
    const auto expected = by_hand(c);
    const std::size_t tiles = 2, block = 500, steps_at_rest = 20'000;
    const auto p = population(c, InstructionSet::baseline);
    ThreadPool pool(1);
    std::vector<Spike> out;
    std::int64_t skipped = 0;
    for (std::size_t at = 0; at < samples + steps_at_rest; at += block) {
        lanes::AlignedBuffer<double> rows(tiles * c.forces * block * tile_width);
        std::vector<std::uint8_t> zero(tiles * c.forces, 1);
        for (std::size_t u = 0; u < c.afferents; ++u)
            for (std::size_t h = 0; h < c.forces; ++h)
                for (std::size_t t = 0; t < block && at + t < samples; ++t) {
                    const double f = c.force[u * c.forces + h][at + t];
                    const std::size_t tile = u / tile_width * c.forces + h;
                    rows.data()[(tile * block + t) * tile_width + u % tile_width] = f;
                    if (f != 0) zero[tile] = 0;
                }
        for (std::size_t tile = 0; tile < zero.size(); ++tile)  // the rows of a tile without force are not read
            if (zero[tile]) std::fill_n(rows.data() + tile * block * tile_width, block * tile_width, std::nan(""));
        PopulationResponse response{&out};
        ASSERT_TRUE(p->respond(ForceTiles<double>{rows.data(), zero.data()}, block, response, pool));
        skipped += response.skipped_steps;
    }
    EXPECT_EQ(out, expected);
    EXPECT_GT(skipped, static_cast<std::int64_t>(steps_at_rest * c.afferents / 2));
}

TEST(SeveralForces, ThatAreNotFiniteOrDoNotFitAreRefused) {
    ForcesCase c("fa1", 3, Method::exact);
    ThreadPool pool(1);
    PopulationResponse response;
    const auto respond = [&](std::size_t count) {
        std::vector<const double*> columns;
        for (const auto& f : c.force) columns.push_back(f.data());
        return population(c, InstructionSet::baseline)->respond(ForceColumns{std::span(columns).first(count)}, 100, response, pool);
    };
    EXPECT_EQ(respond(c.afferents).error().message, "fa1b+lif-b: 70 columns of force for 70 afferents with 3 forces each");
    EXPECT_EQ(population(c, InstructionSet::baseline)->respond(ForceProfile{c.force[0]}, 100, response, pool).error().message,
              "fa1b+lif-b: afferents with 3 forces each cannot have a profile; give columns or tiles");
    EXPECT_TRUE(respond(3 * c.afferents));
    c.force[3 * 66 + 1][50] = std::nan("");
    const auto done = respond(3 * c.afferents);
    ASSERT_FALSE(done);
    EXPECT_EQ(response.failed_afferent, 66U);
    EXPECT_NE(done.error().message.find("the force of sample 50 is nan"), std::string::npos) << done.error().message;
    std::vector<const AfferentPlan*> plans = {&c.plans[0]};
    for (const std::size_t forces : {std::size_t{0}, max_forces + 1})
        EXPECT_EQ(make_lane_population({.plans = plans, .size = 1, .forces = forces}, c.run, InstructionSet::baseline).error().message,
                  fmt::format("{} forces on each afferent: there must be 1 to 100", forces));
    const auto other = population(ForcesCase("fa1", 2, Method::exact), InstructionSet::baseline)->save();
    EXPECT_FALSE(population(c, InstructionSet::baseline)->resume(other));
}

}  // namespace
}  // namespace corpuscle
