// Afferents on SIMD lanes respond like scalar afferents: bit for bit in double precision, for any instruction set, number of threads and
// block size.

#include "model/lane_population.hpp"

#include "model/lanes/aligned_buffer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::force, test::value_or_throw;

/// The instruction sets of this machine that have lanes; the first of all is scalar.
std::span<const InstructionSet> lane_sets() { return instruction_sets().subspan(1); }

/// The plans of a population, and the force of each afferent.
struct Case {
    std::vector<AfferentPlan> plans;         // one for all, or one for each afferent
    std::vector<std::vector<double>> force;  // [afferent][sample], N
    SimulationOptions run;
    std::size_t afferent_count() const { return force.size(); }
    const AfferentPlan& plan(std::size_t u) const { return plans[plans.size() == 1 ? 0 : u]; }
};

/// The spikes of all afferents, each simulated by its scalar model, in the order of populations.
std::vector<Spike> scalar_spikes(const Case& c) {
    std::vector<Spike> out;
    for (std::size_t u = 0; u < c.afferent_count(); ++u) {
        ResponseBlock response{out, static_cast<std::uint32_t>(u)};
        const auto a = make_afferent(c.plan(u), c.run);
        auto state = a->start();
        if (auto ok = a->respond(c.force[u], state, response); !ok) throw std::runtime_error(ok.error().text());
    }
    std::sort(out.begin(), out.end());
    return out;
}

struct LaneOptions {
    InstructionSet set = InstructionSet::baseline;
    Precision precision = Precision::double_precision;
    std::vector<std::size_t> blocks = {4096};  // samples of consecutive blocks; repeated
    ThreadPool* pool = nullptr;                // null: one thread
};

std::unique_ptr<LanePopulation> population(const Case& c, const LaneOptions& options) {
    std::vector<const AfferentPlan*> plans;
    for (const auto& p : c.plans) plans.push_back(&p);
    return value_or_throw(make_lane_population({plans, c.afferent_count(), {}, options.precision}, c.run, options.set));
}

/// Simulates a population in blocks and returns its spikes. feed(population, first, count, response, pool) simulates samples [first, first
/// + count).
template <class Feed>
std::vector<Spike> in_blocks(const Case& c, const LaneOptions& options, const Feed& feed) {
    const auto p = population(c, options);
    ThreadPool own(1);
    std::vector<Spike> out;
    const std::size_t samples = c.force[0].size();
    for (std::size_t k = 0, n = 0; k < samples; ++n) {
        const auto size = std::min(options.blocks[n % options.blocks.size()], samples - k);
        PopulationResponse response{&out};
        if (auto ok = feed(*p, k, size, response, options.pool ? *options.pool : own); !ok) throw std::runtime_error(ok.error().text());
        k += size;
    }
    return out;
}

std::vector<Spike> lane_spikes(const Case& c, const LaneOptions& options) {
    return in_blocks(c, options,
                     [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& response, ThreadPool& pool) {
                         std::vector<const double*> columns;
                         for (const auto& f : c.force) columns.push_back(f.data() + first);
                         return p.respond(ForceColumns{columns}, count, response, pool);
                     });
}

/// The names of every receptor with every neuron.
std::vector<std::string> all_models() {
    std::vector<std::string> names;
    for (const auto& r : receptor_entries())
        for (const auto& n : neuron_entries()) names.push_back(fmt::format("{}+{}", r.name, n.name));
    return names;
}

/// Forces that differ between afferents, strong enough for all of them.
std::vector<std::vector<double>> forces(std::size_t afferent_count, double rate, double seconds) {
    auto press = force("press+noise+chirp", {.settings = {"noise.F_mean=0", "noise.F_sd=0.3N", "chirp.F_mean=0"}, .rate = rate, .seed = 3});
    press.resize(static_cast<std::size_t>(seconds * rate));
    std::vector<std::vector<double>> all;
    for (std::size_t u = 0; u < afferent_count; ++u) {
        auto f = press;
        std::rotate(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(u * 37 % f.size()), f.end());
        for (auto& x : f) x *= 0.25 + static_cast<double>(u % 17) / 8;
        all.push_back(std::move(f));
    }
    return all;
}

/// The plan with random parameters: t_ref is 0 or grows with the index; others vary by 10 % (standard deviation), except V_reset and c
/// (reset voltages, which must stay below the thresholds) and those that all copies share.
AfferentPlan scattered(AfferentPlan plan, std::uint64_t seed, std::uint32_t afferent_index) {
    for (std::uint32_t k = 0; k < plan.values.size(); ++k) {
        const auto& row = (*plan.parameters)[k].info;
        auto& value = plan.values[k];
        if (row.name == "t_ref")
            value = afferent_index % 3 ? 0 : 1e-3 * afferent_index;
        else if (!row.is_shared_by_copies && row.name != "V_reset" && row.name != "c")
            value = std::clamp(value * (1 + 0.1 * normal(seed, afferent_index, k, 0)), row.low, row.high);
    }
    return plan;
}

/// The plan of an afferent. If its model has substeps, they are coarse: fine substeps would only take more time.
AfferentPlan plan_of(const std::string& name) {
    auto plan = value_or_throw(plan_afferent(name));
    if (plan.value("substep")) plan = test::applied_or_throw(plan_afferent(name, test::parse_settings({name + ".substep=200us"})));
    return plan;
}

/// A case in which every afferent has its own force and parameters.
Case individual_parameters(const std::string& name, std::size_t afferent_count, const SimulationOptions& run, double seconds,
                           std::uint64_t seed) {
    Case c{{}, forces(afferent_count, 1 / run.dt, seconds), run};
    const auto plan = plan_of(name);
    for (std::uint32_t u = 0; u < afferent_count; ++u) c.plans.push_back(scattered(plan, seed, u));
    return c;
}

TEST(LanePopulation, EveryModelOnLanesGivesTheSameBitsAsTheScalarModel) {
    for (const auto& name : all_models())
        for (const auto method : {Method::exact, Method::backward_euler})
            for (const bool sampled : {false, true}) {
                const corpuscle::SimulationOptions run{1e-3, method, sampled};
                const Case shared{{plan_of(name)}, forces(70, 1e3, 0.3), run}, individual = individual_parameters(name, 70, run, 0.3, 8);
                const auto expected = scalar_spikes(shared), expected_individual = scalar_spikes(individual);
                if (method == Method::exact) {
                    EXPECT_FALSE(expected.empty()) << name;
                }
                for (const auto set : lane_sets()) {
                    EXPECT_EQ(lane_spikes(shared, {set}), expected) << name << ' ' << name_of(set);
                    EXPECT_EQ(lane_spikes(individual, {set}), expected_individual) << name << ' ' << name_of(set);
                }
            }
}

TEST(LanePopulation, SpikesDoNotDependOnBlocksThreadsOrInstructionSet) {
    ThreadPool three(3);
    EXPECT_TRUE(rc::check("random blocks, models, parameters, instruction sets and threads", [&] {
        const auto names = all_models();
        const auto& name = names[*rc::gen::inRange<std::size_t>(0, names.size())];
        const auto afferent_count = *rc::gen::element<std::size_t>(1, 7, 64, 65, 130);
        const corpuscle::SimulationOptions run{1e-3, *rc::gen::element(Method::exact, Method::backward_euler), *rc::gen::arbitrary<bool>()};
        const auto c = individual_parameters(name, afferent_count, run, 0.2, *rc::gen::inRange<std::uint64_t>(0, 1000));
        const auto sets = lane_sets();
        const auto set = sets[*rc::gen::inRange<std::size_t>(0, sets.size())];
        const auto blocks = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 80)));
        RC_ASSERT(lane_spikes(c, {set, Precision::double_precision, blocks, *rc::gen::arbitrary<bool>() ? &three : nullptr}) ==
                  scalar_spikes(c));
    }));
}

TEST(LanePopulation, AHundredThousandRandomAfferentsEqualScalarOnes) {
    const corpuscle::SimulationOptions run{1e-3, Method::exact};
    const auto plan = value_or_throw(plan_afferent("sa1"));
    const auto press = force("press", {.rate = 1e3});
    std::vector<AfferentPlan> plans;
    for (std::uint32_t u = 0; u < 100'000; ++u) plans.push_back(scattered(plan, 5, u));
    std::vector<const AfferentPlan*> pointers;
    for (const auto& p : plans) pointers.push_back(&p);
    std::vector<Spike> expected;
    for (std::uint32_t u = 0; u < plans.size(); ++u) {
        ResponseBlock response{expected, u};
        const auto a = make_afferent(plans[u], run);
        auto state = a->start();
        ASSERT_TRUE(static_cast<bool>(a->respond(press, state, response)));
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_GT(expected.size(), 1'000'000U);
    for (const auto set : lane_sets())
        for (const unsigned threads : {1U, 2U, 5U}) {
            ThreadPool pool(threads);
            const auto p = value_or_throw(make_lane_population({pointers, plans.size()}, run, set));
            std::vector<Spike> out;
            PopulationResponse response{&out};
            ASSERT_TRUE(static_cast<bool>(p->respond(ForceProfile{press}, press.size(), response, pool)));
            EXPECT_TRUE(out == expected) << name_of(set) << ' ' << threads;
        }
}

/// Samples [first, first + count) of the forces of a case as ForceTiles: for each tile of tile_width afferents, the samples one after
/// another, each with one value per afferent, in units of `scale` (N). The last tile is padded with zeros.
template <class E>
lanes::AlignedBuffer<E> tiles(const Case& c, std::size_t first, std::size_t count, double scale) {
    lanes::AlignedBuffer<E> rows((c.afferent_count() + tile_width - 1) / tile_width * tile_width * count);
    for (std::size_t u = 0; u < c.afferent_count(); ++u)
        for (std::size_t t = 0; t < count; ++t)
            rows.data()[(u / tile_width * count + t) * tile_width + u % tile_width] = static_cast<E>(c.force[u][first + t] / scale);
    return rows;
}

TEST(LanePopulation, TilesAndInt16ForcesGiveTheSpikesOfColumns) {
    constexpr double newtons = 1.0 / 4096;
    const corpuscle::SimulationOptions run{5e-4};
    Case c{{value_or_throw(plan_afferent("sa1"))}, forces(150, 2e3, 0.4), run};
    for (auto& f : c.force)
        for (auto& x : f) x = std::nearbyint(std::clamp(x, -7.9, 7.9) / newtons) * newtons;  // values that an int16 word can hold
    const auto expected = scalar_spikes(c);
    ASSERT_FALSE(expected.empty());
    for (const auto set : lane_sets()) {
        EXPECT_EQ(in_blocks(c, {set, Precision::double_precision, {33, 100}},
                            [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& response, ThreadPool& pool) {
                                const auto rows = tiles<double>(c, first, count, 1);
                                return p.respond(ForceTiles<double>{rows.data()}, count, response, pool);
                            }),
                  expected);
        EXPECT_EQ(in_blocks(c, {set, Precision::double_precision, {33, 100}},
                            [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& response, ThreadPool& pool) {
                                const auto rows = tiles<std::int16_t>(c, first, count, newtons);
                                return p.respond(ForceInt16{rows.data(), newtons}, count, response, pool);
                            }),
                  expected);
    }
}

TEST(LanePopulation, AProfileGivesTheSpikesOfEqualColumns) {
    for (const auto& name : all_models()) {
        Case c = individual_parameters(name, 70, {5e-4}, 0.3, 4);
        for (auto& f : c.force) f = c.force[0];
        const auto by_profile = [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& response,
                                    ThreadPool& pool) {
            return p.respond(ForceProfile{std::span(c.force[0]).subspan(first, count)}, count, response, pool);
        };
        for (const auto set : lane_sets())
            EXPECT_EQ(in_blocks(c, {set, Precision::double_precision, {77}}, by_profile), scalar_spikes(c)) << name;
        Case same{{c.plans[0]}, c.force, c.run};  // equal parameters: the receptor is computed once for all afferents
        for (const auto set : lane_sets())
            EXPECT_EQ(in_blocks(same, {set, Precision::double_precision, {77}}, by_profile), scalar_spikes(same)) << name;
    }
}

TEST(LanePopulation, AProfileWithGainsGivesTheSpikesOfScaledColumnsWithinRounding) {
    for (const auto& receptor : receptor_entries()) {
        const std::string name = fmt::format("{}+lif-b", receptor.name);
        for (const auto method : {Method::exact, Method::backward_euler}) {
            Case c{{value_or_throw(plan_afferent(name))}, forces(64, 2e3, 0.5), {5e-4, method}};
            std::vector<double> gain;
            for (std::size_t u = 0; u < c.afferent_count(); ++u) gain.push_back(static_cast<double>(u) / 20);
            const auto profile = c.force[3];
            for (std::size_t u = 0; u < c.afferent_count(); ++u)
                for (std::size_t t = 0; t < profile.size(); ++t) c.force[u][t] = gain[u] * profile[t];
            const auto expected = scalar_spikes(c);
            ASSERT_FALSE(expected.empty());
            const auto found =
                in_blocks(c, {lane_sets().back(), Precision::double_precision, {100}},
                          [&](LanePopulation& p, std::size_t first, std::size_t count, PopulationResponse& response, ThreadPool& pool) {
                              return p.respond(ForceProfile{std::span(profile).subspan(first, count), gain}, count, response, pool);
                          });
            ASSERT_EQ(found.size(), expected.size()) << name;
            for (std::size_t k = 0; k < found.size(); ++k) {
                ASSERT_EQ(found[k].afferent_index, expected[k].afferent_index) << name;
                ASSERT_NEAR(static_cast<double>(found[k].step) + found[k].offset,
                            static_cast<double>(expected[k].step) + expected[k].offset, 1e-7);
            }
        }
    }
}

TEST(LanePopulation, SpikeBitsEqualTheListOfSpikes) {
    const corpuscle::SimulationOptions run{5e-4, Method::exact, true};
    const Case c{{value_or_throw(plan_afferent("sa1"))}, forces(100, 2e3, 0.4), run};
    std::vector<const double*> columns;
    for (const auto& f : c.force) columns.push_back(f.data());
    const std::size_t steps = c.force[0].size();
    for (const auto set : lane_sets()) {
        std::vector<std::uint64_t> marks;
        PopulationResponse response{nullptr, &marks};
        ThreadPool pool(2);
        ASSERT_TRUE(static_cast<bool>(population(c, {set})->respond(ForceColumns{columns}, steps, response, pool)));
        ASSERT_EQ(marks.size(), 2 * steps);  // 100 afferents need two words of 64 bits per step
        std::vector<std::uint64_t> expected(marks.size());
        std::int64_t extra_spikes = 0;  // second and later spikes of an afferent in one step, which have no bit of their own
        for (const auto& s : scalar_spikes(c)) {
            auto& word = expected[s.afferent_index / 64 * steps + static_cast<std::size_t>(s.step)];
            const auto bit = std::uint64_t{1} << s.afferent_index % 64;
            extra_spikes += (word & bit) != 0;
            word |= bit;
        }
        EXPECT_EQ(marks, expected);
        EXPECT_EQ(response.extra_spikes, extra_spikes);
    }
}

TEST(LanePopulation, ANonFiniteForceIsRefusedByAfferentAndSampleInEveryModel) {
    for (const auto& name : all_models())
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
            for (const std::size_t at : {0, 1, 50, 99}) {
                Case c{{plan_of(name)}, forces(70, 1e3, 0.1), {1e-3}};
                c.force[66][at] = bad;
                std::vector<const double*> columns;
                for (const auto& f : c.force) columns.push_back(f.data());
                for (const auto set : lane_sets()) {
                    std::vector<Spike> out;
                    PopulationResponse response{&out};
                    ThreadPool pool(1);
                    const auto done = population(c, {set})->respond(ForceColumns{columns}, 100, response, pool);
                    ASSERT_FALSE(done) << name << ' ' << bad << ' ' << at << ' ' << name_of(set);
                    EXPECT_EQ(response.failed_afferent, 66U) << name;
                    EXPECT_NE(done.error().message.find(fmt::format("the force of sample {} is", at)), std::string::npos)
                        << done.error().message;
                }
            }
}

TEST(LanePopulation, AfferentsThatCannotShareLanesAreRefused) {
    const auto refused = [](std::vector<AfferentPlan> plans, const corpuscle::SimulationOptions& run = {}) {
        std::vector<const AfferentPlan*> pointers;
        for (const auto& p : plans) pointers.push_back(&p);
        const auto made = make_lane_population({pointers, plans.size()}, run, InstructionSet::baseline);
        return made ? std::string() : made.error().message;
    };
    const auto plan = [](const std::string& name, const std::vector<std::string>& settings = {}) {
        return test::applied_or_throw(plan_afferent(name, test::parse_settings(settings)));
    };
    EXPECT_EQ(refused({plan("sa1"), plan("sa1", {"sa1.f_B=30"})}), "");
    EXPECT_NE(refused({plan("sa1"), plan("fa1")}).find("cannot contain"), std::string::npos);
    EXPECT_NE(refused({plan("sa1b+adex"), plan("sa1b+adex", {"sa1b+adex.substep=10us"})}).find("substep must be the same"),
              std::string::npos);
    EXPECT_NE(refused({plan("fsr+sa1")}).find("cannot run on SIMD lanes"), std::string::npos);
    EXPECT_NE(refused({plan("sa1")}, {.noise = 1e-9}).find("cannot run on SIMD lanes"), std::string::npos);
    EXPECT_NE(refused({}).find("0 afferents"), std::string::npos);
}

TEST(LanePopulation, AForceWithAnotherLayoutOrSizeIsRefused) {
    const Case c{{value_or_throw(plan_afferent("sa1"))}, forces(3, 1e3, 0.1), {1e-3}};
    const auto p = population(c, {});
    ThreadPool pool(1);
    PopulationResponse response;
    std::vector<const double*> columns;
    for (const auto& f : c.force) columns.push_back(f.data());
    EXPECT_FALSE(p->respond(ForceProfile{c.force[0]}, c.force[0].size() + 1, response, pool));
    ASSERT_TRUE(static_cast<bool>(p->respond(ForceColumns{columns}, 10, response, pool))) << "a refused block does not fix the layout";
    EXPECT_FALSE(p->respond(ForceProfile{c.force[0]}, 10, response, pool));
    const float row[tile_width] = {};
    EXPECT_FALSE(population(c, {})->respond(ForceTiles<float>{row}, 1, response, pool));
    const std::vector<double> negative = {1, -1, 1}, few = {1, 1};
    EXPECT_FALSE(population(c, {})->respond(ForceProfile{c.force[0], negative}, 10, response, pool));
    EXPECT_FALSE(population(c, {})->respond(ForceProfile{c.force[0], few}, 10, response, pool));
    EXPECT_FALSE(population(c, {})->respond(ForceProfile{c.force[0]}, c.force[0].size() + 1, response, pool));
    EXPECT_FALSE(population(c, {})->respond(ForceColumns{std::span(columns).first(2)}, 10, response, pool));

    // The current of sa1a does not scale with force. So its receptor is computed once for a profile without gains, but for each afferent if
    // there are gains; a population must not change from one to the other.
    const Case mixed{{value_or_throw(plan_afferent("sa1a+lif-b"))}, c.force, c.run};
    const std::vector<double> ones = {1, 1, 1};
    const auto m = population(mixed, {});
    ASSERT_TRUE(static_cast<bool>(m->respond(ForceProfile{c.force[0]}, 10, response, pool)));
    EXPECT_FALSE(m->respond(ForceProfile{c.force[0], ones}, 10, response, pool));
}

/// Compares single precision on lanes with the scalar models in double precision: each afferent must fire the same number of spikes, at
/// times that differ by at most `bound` (s).
void expect_near(const Case& c, InstructionSet set, double bound) {
    const auto trains = [&](const std::vector<Spike>& all) {
        std::vector<std::vector<double>> of(c.afferent_count());
        for (const auto& s : all) of[s.afferent_index].push_back((static_cast<double>(s.step) + s.offset) * c.run.dt);
        return of;
    };
    const auto expected = trains(scalar_spikes(c)), found = trains(lane_spikes(c, {set, Precision::single_precision}));
    for (std::size_t u = 0; u < c.afferent_count(); ++u) {
        ASSERT_EQ(found[u].size(), expected[u].size()) << u;
        for (std::size_t k = 0; k < expected[u].size(); ++k) ASSERT_NEAR(found[u][k], expected[u][k], bound) << u << ' ' << k;
    }
}

TEST(LanePopulation, FloatFiresTheSameSpikesUnderThePressWithinFiftyMicroseconds) {
    for (const auto* name : {"sa1", "fa1", "sa2"})
        for (const auto set : lane_sets())
            for (const auto method : {Method::exact, Method::backward_euler}) {
                const Case c{{value_or_throw(plan_afferent(name))}, {force("press")}, {1e-4, method}};
                expect_near(c, set, 50e-6);
            }
}

TEST(LanePopulation, FloatIsTheSameOnEveryInstructionSet) {
    for (const auto& name : all_models()) {
        const auto c = individual_parameters(name, 70, {5e-4}, 0.3, 2);
        const auto expected = lane_spikes(c, {InstructionSet::baseline, Precision::single_precision});
        for (const auto set : lane_sets())
            EXPECT_EQ(lane_spikes(c, {set, Precision::single_precision}), expected) << name << ' ' << name_of(set);
    }
}

}  // namespace
}  // namespace corpuscle
