// Afferents on lanes answer as they do one by one: to the bit in double, whatever the instruction set, the threads, the blocks.

#include "model/lane_population.hpp"

#include "model/lanes/aligned_buffer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::force, test::value_or_throw;

std::span<const InstructionSet> lane_sets() { return instruction_sets().subspan(1); }

/// A population's plans, and the force of each unit.
struct Case {
    std::vector<AfferentPlan> plans;  // one, or one a unit
    std::vector<std::vector<double>> force;
    SimulationOptions run;
    std::size_t units() const { return force.size(); }
    const AfferentPlan& plan(std::size_t u) const { return plans[plans.size() == 1 ? 0 : u]; }
};

std::vector<Spike> one_by_one(const Case& c) {
    std::vector<Spike> out;
    for (std::size_t u = 0; u < c.units(); ++u) {
        ResponseBlock answer{out, static_cast<std::uint32_t>(u)};
        const auto a = make_afferent(c.plan(u), c.run);
        auto state = a->start();
        if (auto ok = a->respond(c.force[u], state, answer); !ok) throw std::runtime_error(ok.error().text());
    }
    std::sort(out.begin(), out.end());
    return out;
}

struct How {
    InstructionSet set = InstructionSet::baseline;
    Precision precision = Precision::double_precision;
    std::vector<std::size_t> blocks = {4096};
    ThreadPool* pool = nullptr;
};

std::unique_ptr<LanePopulation> population(const Case& c, const How& how) {
    std::vector<const AfferentPlan*> plans;
    for (const auto& p : c.plans) plans.push_back(&p);
    return value_or_throw(make_lane_population({plans, c.units(), {}, how.precision}, c.run, how.set));
}

/// Answers in blocks; feed(first, count, answer) hands each one in.
template <class Feed>
std::vector<Spike> in_blocks(const Case& c, const How& how, const Feed& feed) {
    const auto p = population(c, how);
    ThreadPool own(1);
    std::vector<Spike> out;
    const std::size_t samples = c.force[0].size();
    for (std::size_t k = 0, n = 0; k < samples; ++n) {
        const auto size = std::min(how.blocks[n % how.blocks.size()], samples - k);
        PopulationResponse answer{&out};
        if (auto ok = feed(*p, k, size, answer, how.pool ? *how.pool : own); !ok) throw std::runtime_error(ok.error().text());
        k += size;
    }
    return out;
}

std::vector<Spike> on_lanes(const Case& c, const How& how) {
    return in_blocks(c, how, [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& answer, ThreadPool& pool) {
        std::vector<const double*> columns;
        for (const auto& f : c.force) columns.push_back(f.data() + first);
        return p.respond(ForceColumns{columns}, count, answer, pool);
    });
}

std::vector<std::string> every_chain() {
    std::vector<std::string> names;
    for (const auto& r : receptor_entries())
        for (const auto& n : neuron_entries()) names.push_back(fmt::format("{}+{}", r.name, n.name));
    return names;
}

/// Forces that differ from unit to unit, brisk enough for all of them.
std::vector<std::vector<double>> forces(std::size_t units, double rate, double seconds) {
    auto press = force("press+noise+chirp", {.settings = {"noise.F_mean=0", "noise.F_sd=0.3N", "chirp.F_mean=0"}, .rate = rate, .seed = 3});
    press.resize(static_cast<std::size_t>(seconds * rate));
    std::vector<std::vector<double>> all;
    for (std::size_t u = 0; u < units; ++u) {
        auto f = press;
        std::rotate(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(u * 37 % f.size()), f.end());
        for (auto& x : f) x *= 0.25 + static_cast<double>(u % 17) / 8;
        all.push_back(std::move(f));
    }
    return all;
}

/// A plan whose parameters lie about their defaults.
AfferentPlan scattered(AfferentPlan plan, std::uint64_t seed, std::uint32_t unit) {
    for (std::uint32_t k = 0; k < plan.values.size(); ++k) {
        const auto& row = (*plan.parameters)[k].info;
        auto& value = plan.values[k];
        if (row.name == "t_ref")
            value = unit % 3 ? 0 : 1e-3 * unit;
        else if (!row.is_shared_by_copies && row.name != "V_reset" && row.name != "c")
            value = std::clamp(value * (1 + 0.1 * normal(seed, unit, k, 0)), row.low, row.high);
    }
    return plan;
}

/// With coarse substeps, where there are any: they take the time and are all alike.
AfferentPlan plan_of(const std::string& name) {
    auto plan = value_or_throw(plan_afferent(name, {}));
    if (plan.value("substep")) plan = value_or_throw(plan_afferent(name, test::parse_settings({name + ".substep=200us"})));
    return plan;
}

Case own_parameters(const std::string& name, std::size_t units, const SimulationOptions& run, double seconds, std::uint64_t seed) {
    Case c{{}, forces(units, 1 / run.dt, seconds), run};
    const auto plan = plan_of(name);
    for (std::uint32_t u = 0; u < units; ++u) c.plans.push_back(scattered(plan, seed, u));
    return c;
}

TEST(LanePopulation, EveryChainOnLanesGivesTheBitsOfOneByOne) {
    for (const auto& name : every_chain())
        for (const auto method : {Method::exact, Method::backward_euler})
            for (const bool sampled : {false, true}) {
                const corpuscle::SimulationOptions run{1e-3, method, sampled};
                const Case shared{{plan_of(name)}, forces(70, 1e3, 0.3), run}, own = own_parameters(name, 70, run, 0.3, 8);
                const auto right = one_by_one(shared), right_own = one_by_one(own);
                if (method == Method::exact) {
                    EXPECT_FALSE(right.empty()) << name;
                }
                for (const auto set : lane_sets()) {
                    EXPECT_EQ(on_lanes(shared, {set}), right) << name << ' ' << name_of(set);
                    EXPECT_EQ(on_lanes(own, {set}), right_own) << name << ' ' << name_of(set);
                }
            }
}

TEST(LanePopulation, AnyChunksAnyThreadsAnyLanesGiveTheSameSpikes) {
    ThreadPool three(3);
    EXPECT_TRUE(rc::check("random blocks, chains, spreads, sets and threads", [&] {
        const auto names = every_chain();
        const auto& name = names[*rc::gen::inRange<std::size_t>(0, names.size())];
        const auto units = *rc::gen::element<std::size_t>(1, 7, 64, 65, 130);
        const corpuscle::SimulationOptions run{1e-3, *rc::gen::element(Method::exact, Method::backward_euler), *rc::gen::arbitrary<bool>()};
        const auto c = own_parameters(name, units, run, 0.2, *rc::gen::inRange<std::uint64_t>(0, 1000));
        const auto sets = lane_sets();
        const auto set = sets[*rc::gen::inRange<std::size_t>(0, sets.size())];
        const auto blocks = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 80)));
        RC_ASSERT(on_lanes(c, {set, Precision::double_precision, blocks, *rc::gen::arbitrary<bool>() ? &three : nullptr}) == one_by_one(c));
    }));
}

TEST(LanePopulation, AHundredThousandRandomAfferentsAnswerAsOneByOne) {
    const corpuscle::SimulationOptions run{1e-3, Method::exact};
    const auto plan = value_or_throw(plan_afferent("sa1", {}));
    const auto press = force("press", {.rate = 1e3});
    std::vector<AfferentPlan> plans;
    for (std::uint32_t u = 0; u < 100'000; ++u) plans.push_back(scattered(plan, 5, u));
    std::vector<const AfferentPlan*> pointers;
    for (const auto& p : plans) pointers.push_back(&p);
    std::vector<Spike> right;
    for (std::uint32_t u = 0; u < plans.size(); ++u) {
        ResponseBlock answer{right, u};
        const auto a = make_afferent(plans[u], run);
        auto state = a->start();
        ASSERT_TRUE(static_cast<bool>(a->respond(press, state, answer)));
    }
    std::sort(right.begin(), right.end());
    EXPECT_GT(right.size(), 1'000'000U);
    for (const auto set : lane_sets())
        for (const unsigned threads : {1U, 2U, 5U}) {
            ThreadPool pool(threads);
            const auto p = value_or_throw(make_lane_population({pointers, plans.size()}, run, set));
            std::vector<Spike> out;
            PopulationResponse answer{&out};
            ASSERT_TRUE(static_cast<bool>(p->respond(ForceProfile{press}, press.size(), answer, pool)));
            EXPECT_TRUE(out == right) << name_of(set) << ' ' << threads;
        }
}

/// The forces of a case as tiles, padded.
template <class E>
lanes::AlignedBuffer<E> tiles(const Case& c, std::size_t first, std::size_t count, double scale) {
    lanes::AlignedBuffer<E> rows((c.units() + tile_width - 1) / tile_width * tile_width * count);
    for (std::size_t u = 0; u < c.units(); ++u)
        for (std::size_t t = 0; t < count; ++t)
            rows.data()[(u / tile_width * count + t) * tile_width + u % tile_width] = static_cast<E>(c.force[u][first + t] / scale);
    return rows;
}

TEST(LanePopulation, TilesAndWordsAreReadAsColumnsAre) {
    constexpr double newtons = 1.0 / 4096;
    const corpuscle::SimulationOptions run{5e-4};
    Case c{{value_or_throw(plan_afferent("sa1", {}))}, forces(150, 2e3, 0.4), run};
    for (auto& f : c.force)
        for (auto& x : f) x = std::nearbyint(std::clamp(x, -7.9, 7.9) / newtons) * newtons;  // what a word can say
    const auto right = one_by_one(c);
    ASSERT_FALSE(right.empty());
    for (const auto set : lane_sets()) {
        EXPECT_EQ(in_blocks(c, {set, Precision::double_precision, {33, 100}},
                            [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& answer, ThreadPool& pool) {
                                const auto rows = tiles<double>(c, first, count, 1);
                                return p.respond(ForceTiles<double>{rows.data()}, count, answer, pool);
                            }),
                  right);
        EXPECT_EQ(in_blocks(c, {set, Precision::double_precision, {33, 100}},
                            [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& answer, ThreadPool& pool) {
                                const auto rows = tiles<std::int16_t>(c, first, count, newtons);
                                return p.respond(ForceInt16{rows.data(), newtons}, count, answer, pool);
                            }),
                  right);
    }
}

TEST(LanePopulation, OneProfileIsEveryUnitsOwnForce) {
    for (const auto& name : every_chain()) {
        Case c = own_parameters(name, 70, {5e-4}, 0.3, 4);
        for (auto& f : c.force) f = c.force[0];
        const auto by_profile = [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& answer, ThreadPool& pool) {
            return p.respond(ForceProfile{std::span(c.force[0]).subspan(first, count)}, count, answer, pool);
        };
        for (const auto set : lane_sets()) EXPECT_EQ(in_blocks(c, {set, Precision::double_precision, {77}}, by_profile), one_by_one(c)) << name;
        Case same{{c.plans[0]}, c.force, c.run};  // transduced once
        for (const auto set : lane_sets())
            EXPECT_EQ(in_blocks(same, {set, Precision::double_precision, {77}}, by_profile), one_by_one(same)) << name;
    }
}

TEST(LanePopulation, AGainTimesAProfileIsThatForceToRoundingWhetherTransducedOnceOrByEach) {
    for (const auto& receptor : receptor_entries()) {
        const std::string name = fmt::format("{}+lif-b", receptor.name);
        for (const auto method : {Method::exact, Method::backward_euler}) {
            Case c{{value_or_throw(plan_afferent(name, {}))}, forces(64, 2e3, 0.5), {5e-4, method}};
            std::vector<double> gain;
            for (std::size_t u = 0; u < c.units(); ++u) gain.push_back(static_cast<double>(u) / 20);
            const auto profile = c.force[3];
            for (std::size_t u = 0; u < c.units(); ++u)
                for (std::size_t t = 0; t < profile.size(); ++t) c.force[u][t] = gain[u] * profile[t];
            const auto right = one_by_one(c);
            ASSERT_FALSE(right.empty());
            const auto found =
                in_blocks(c, {lane_sets().back(), Precision::double_precision, {100}},
                          [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& answer, ThreadPool& pool) {
                              return p.respond(ForceProfile{std::span(profile).subspan(first, count), gain}, count, answer, pool);
                          });
            ASSERT_EQ(found.size(), right.size()) << name;
            for (std::size_t k = 0; k < found.size(); ++k) {
                ASSERT_EQ(found[k].afferent_index, right[k].afferent_index) << name;
                ASSERT_NEAR(static_cast<double>(found[k].step) + found[k].offset, static_cast<double>(right[k].step) + right[k].offset,
                            1e-7);
            }
        }
    }
}

TEST(LanePopulation, MarksAreTheSampledSpikes) {
    const corpuscle::SimulationOptions run{5e-4, Method::exact, true};
    const Case c{{value_or_throw(plan_afferent("sa1", {}))}, forces(100, 2e3, 0.4), run};
    std::vector<const double*> columns;
    for (const auto& f : c.force) columns.push_back(f.data());
    const std::size_t steps = c.force[0].size();
    for (const auto set : lane_sets()) {
        std::vector<std::uint64_t> marks;
        PopulationResponse answer{nullptr, &marks};
        ThreadPool pool(2);
        ASSERT_TRUE(static_cast<bool>(population(c, {set})->respond(ForceColumns{columns}, steps, answer, pool)));
        ASSERT_EQ(marks.size(), 2 * steps);
        std::vector<std::uint64_t> right(marks.size());
        std::int64_t again = 0;
        for (const auto& s : one_by_one(c)) {
            auto& word = right[s.afferent_index / 64 * steps + static_cast<std::size_t>(s.step)];
            const auto bit = std::uint64_t{1} << s.afferent_index % 64;
            again += (word & bit) != 0;
            word |= bit;
        }
        EXPECT_EQ(marks, right);
        EXPECT_EQ(answer.extra_spikes, again);
    }
}

TEST(LanePopulation, AForceThatIsNoNumberIsRefusedByUnitAndSampleInEveryChain) {
    for (const auto& name : every_chain())
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
            for (const std::size_t at : {0, 1, 50, 99}) {
                Case c{{plan_of(name)}, forces(70, 1e3, 0.1), {1e-3}};
                c.force[66][at] = bad;
                std::vector<const double*> columns;
                for (const auto& f : c.force) columns.push_back(f.data());
                for (const auto set : lane_sets()) {
                    std::vector<Spike> out;
                    PopulationResponse answer{&out};
                    ThreadPool pool(1);
                    const auto done = population(c, {set})->respond(ForceColumns{columns}, 100, answer, pool);
                    ASSERT_FALSE(done) << name << ' ' << bad << ' ' << at << ' ' << name_of(set);
                    EXPECT_EQ(answer.failed_afferent, 66U) << name;
                    EXPECT_NE(done.error().message.find(fmt::format("the force of sample {} is", at)), std::string::npos)
                        << done.error().message;
                }
            }
}

TEST(LanePopulation, WhatCannotStandSideBySideIsRefused) {
    const auto refused = [](std::vector<AfferentPlan> plans, const corpuscle::SimulationOptions& run = {}) {
        std::vector<const AfferentPlan*> pointers;
        for (const auto& p : plans) pointers.push_back(&p);
        const auto made = make_lane_population({pointers, plans.size()}, run, InstructionSet::baseline);
        return made ? std::string() : made.error().message;
    };
    const auto plan = [](const std::string& name, const std::vector<std::string>& settings = {}) {
        return value_or_throw(plan_afferent(name, test::parse_settings(settings)));
    };
    EXPECT_EQ(refused({plan("sa1"), plan("sa1", {"sa1.f_B=30"})}), "");
    EXPECT_NE(refused({plan("sa1"), plan("fa1")}).find("cannot contain"), std::string::npos);
    EXPECT_NE(refused({plan("sa1b+adex"), plan("sa1b+adex", {"sa1b+adex.substep=10us"})}).find("substep must be the same"),
              std::string::npos);
    EXPECT_NE(refused({plan("fsr+sa1")}).find("cannot run on SIMD lanes"), std::string::npos);
    EXPECT_NE(refused({plan("sa1")}, {.noise = 1e-9}).find("cannot run on SIMD lanes"), std::string::npos);
    EXPECT_NE(refused({}).find("0 afferents"), std::string::npos);
}

TEST(LanePopulation, ItsForceKeepsToOneWay) {
    const Case c{{value_or_throw(plan_afferent("sa1", {}))}, forces(3, 1e3, 0.1), {1e-3}};
    const auto p = population(c, {});
    ThreadPool pool(1);
    PopulationResponse answer;
    std::vector<const double*> columns;
    for (const auto& f : c.force) columns.push_back(f.data());
    ASSERT_TRUE(static_cast<bool>(p->respond(ForceColumns{columns}, 10, answer, pool)));
    EXPECT_FALSE(p->respond(ForceProfile{c.force[0]}, 10, answer, pool));
    const float row[tile_width] = {};
    EXPECT_FALSE(population(c, {})->respond(ForceTiles<float>{row}, 1, answer, pool));
    const std::vector<double> negative = {1, -1, 1}, few = {1, 1};
    EXPECT_FALSE(population(c, {})->respond(ForceProfile{c.force[0], negative}, 10, answer, pool));
    EXPECT_FALSE(population(c, {})->respond(ForceProfile{c.force[0], few}, 10, answer, pool));
    EXPECT_FALSE(population(c, {})->respond(ForceProfile{c.force[0]}, c.force[0].size() + 1, answer, pool));
    EXPECT_FALSE(population(c, {})->respond(ForceColumns{std::span(columns).first(2)}, 10, answer, pool));

    // sa1a's current does not scale with force: without gains it is transduced once, with gains by each unit.
    const Case mixed{{value_or_throw(plan_afferent("sa1a+lif-b", {}))}, c.force, c.run};
    const std::vector<double> ones = {1, 1, 1};
    const auto m = population(mixed, {});
    ASSERT_TRUE(static_cast<bool>(m->respond(ForceProfile{c.force[0]}, 10, answer, pool)));
    EXPECT_FALSE(m->respond(ForceProfile{c.force[0], ones}, 10, answer, pool));
}

/// Float against double, afferent by afferent: the same number of spikes, none further away than `bound`.
void expect_near(const Case& c, InstructionSet set, double bound) {
    const auto trains = [&](const std::vector<Spike>& all) {
        std::vector<std::vector<double>> of(c.units());
        for (const auto& s : all) of[s.afferent_index].push_back((static_cast<double>(s.step) + s.offset) * c.run.dt);
        return of;
    };
    const auto right = trains(one_by_one(c)), found = trains(on_lanes(c, {set, Precision::single_precision}));
    for (std::size_t u = 0; u < c.units(); ++u) {
        ASSERT_EQ(found[u].size(), right[u].size()) << u;
        for (std::size_t k = 0; k < right[u].size(); ++k) ASSERT_NEAR(found[u][k], right[u][k], bound) << u << ' ' << k;
    }
}

TEST(LanePopulation, FloatGivesThePressTheSameSpikesWithinFiftyMicroseconds) {
    for (const auto* name : {"sa1", "fa1", "sa2"})
        for (const auto set : lane_sets())
            for (const auto method : {Method::exact, Method::backward_euler}) {
                const Case c{{value_or_throw(plan_afferent(name, {}))}, {force("press")}, {1e-4, method}};
                expect_near(c, set, 50e-6);
            }
}

TEST(LanePopulation, FloatIsTheSameFloatOnEverySet) {
    for (const auto& name : every_chain()) {
        const auto c = own_parameters(name, 70, {5e-4}, 0.3, 2);
        const auto right = on_lanes(c, {InstructionSet::baseline, Precision::single_precision});
        for (const auto set : lane_sets()) EXPECT_EQ(on_lanes(c, {set, Precision::single_precision}), right) << name << ' ' << name_of(set);
    }
}

}  // namespace
}  // namespace corpuscle
