// A skin gives the spikes of its afferents simulated one at a time, for any block lengths, numbers of threads and instruction sets, and
// after its state is saved and resumed.

#include "skin/skin.hpp"

#include <limits>
#include <numeric>

#include "core/bytes.hpp"
#include "core/random.hpp"
#include "model/catalog.hpp"
#include "skin/conduction.hpp"
#include "skin/wave/contact_wave.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

constexpr double skin_T = 1e-3;  // sampling period, s

/// Three classes on a grid of sites. `wave`: fa1 and sa2 feel contact waves, whose delays are up to about 13 samples. `spread`: true if the
/// thresholds V_th vary between afferents. `velocity`: of conduction, m/s; 0 means no delays.
std::shared_ptr<const Innervation> small_skin(std::size_t rows, std::size_t columns, bool spread, double velocity, bool wave = false) {
    SkinPlan plan{"small", "", *grid_sites(rows, columns, 2e-3), {}, 7};
    for (const char* name : {"sa1", "fa1", "sa2"}) {
        SkinClass c{name, *plan_afferent(name)};
        c.per_site = 2, c.sigma = 1.5e-3, c.hot_spots = 2, c.hot_spot_spread = 1e-3;
        c.velocity = velocity, c.velocity_spread = velocity / 10;
        if (wave && c.name != "sa1") c.wave = {.speed = 1.5, .gain = c.name == "sa2" ? 0.5 : 2};
        if (spread) c.distributions.push_back({name, "V_th", "V", 0.03, {}});
        plan.classes.push_back(std::move(c));
    }
    if (velocity > 0) plan.nerve = Position{0, -0.2, 0};
    auto skin = innervate(std::move(plan));
    EXPECT_TRUE(skin) << skin.error().text();
    return *skin;
}

/// One press on each of about two thirds of the sites, with random start and duration: force[site * steps + step] in N. The time without
/// force is long enough for the state of afferents to decay to zero.
struct PressPattern {
    std::size_t sites, steps;
    std::vector<double> force;
    PressPattern(std::size_t sites, std::size_t steps, std::uint64_t seed) : sites(sites), steps(steps), force(sites * steps) {
        for (std::size_t s = 0; s < sites; ++s) {
            const auto w = philox({static_cast<std::uint32_t>(s), 0, 0, 0}, seed);
            if (w[0] % 3 == 0) continue;
            const std::size_t from = w[1] % steps, to = std::min(steps, from + w[2] % 300);
            for (std::size_t t = from; t < to; ++t) force[s * steps + t] = 10e-3 * static_cast<double>((w[3] + 7 * t) % 4001);
        }
    }
    /// The force from this step on.
    SiteForce at(std::size_t step) const { return {force.data() + step, steps}; }
};

std::unique_ptr<Skin> make_skin(const std::shared_ptr<const Innervation>& skin, InstructionSet set = *instruction_set(),
                                SkinPart part = {}) {
    auto made = Skin::make(skin, SimulationOptions{skin_T}, set == InstructionSet::scalar ? InstructionSet::baseline : set, part);
    EXPECT_TRUE(made) << made.error().text();
    return std::move(*made);
}

/// The spikes of the complete pattern, including those that conduction delays past its end.
std::vector<Spike> simulate_all(Skin& skin, const PressPattern& touch, ThreadPool& pool) {
    std::vector<Spike> spikes;
    EXPECT_TRUE(skin.respond(touch.at(0), touch.steps, spikes, pool));
    skin.finish(spikes);
    return spikes;
}

/// Adds the contact waves of a class to the force on its afferents, forces[afferent * steps + step].
void add_waves(const Innervation& map, std::size_t class_index, const PressPattern& touch, std::vector<double>& forces) {
    ThreadPool pool(1);
    const auto count = map.class_begin[class_index + 1] - map.class_begin[class_index];
    const auto wave = *ContactWave::make(map, class_index, 0, count, skin_T, *instruction_set());
    std::vector<std::uint32_t> all_sites(touch.sites);
    std::iota(all_sites.begin(), all_sites.end(), 0U);
    for (std::size_t at = 0; at < touch.steps; ++at) {
        wave->compute(touch.at(0), all_sites, at, 1, pool);
        for (std::size_t u = 0; u < count; ++u)
            if (const double* f = wave->force_on(u)) forces[u * touch.steps + at] += *f;
    }
}

class SkinWithWaves : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Skin, SkinWithWaves, ::testing::Bool());

TEST_P(SkinWithWaves, RespondsLikeItsAfferentsSimulatedSeparately) {
    ThreadPool pool(1);
    const auto map = small_skin(5, 6, true, 40, GetParam());
    const PressPattern touch(30, 9000, 3);  // long enough for the states of afferents to decay to zero, and for new presses after that
    auto skin = make_skin(map);
    const auto spikes = simulate_all(*skin, touch, pool);
    EXPECT_GT(skin->stats().skipped_steps, 0);
    std::vector<Spike> separate;
    for (std::size_t c = 0; c < map->plan.classes.size(); ++c) {
        const auto& f = map->fields[c];
        const std::size_t first = map->class_begin[c], count = map->class_begin[c + 1] - first;
        const auto plans = make_copies(map->plan.classes[c].afferent, static_cast<std::uint32_t>(count), map->plan.classes[c].distributions,
                                       map->plan.seed);
        std::vector<double> forces(count * touch.steps);
        for (std::size_t s = 0; s < touch.sites; ++s)
            for (std::size_t k = f.begin[s]; k < f.begin[s + 1]; ++k)
                for (std::size_t t = 0; t < touch.steps; ++t)
                    forces[f.afferent[k] * touch.steps + t] += f.weight[k] * touch.force[s * touch.steps + t];
        if (map->plan.classes[c].wave.speed > 0) add_waves(*map, c, touch, forces);
        for (std::size_t u = 0; u < count; ++u) {
            const auto afferent = make_afferent((*plans)[u], corpuscle::SimulationOptions{skin_T});
            auto state = afferent->start();
            std::vector<Spike> fired;
            ResponseBlock response{fired, static_cast<std::uint32_t>(first + u)};
            ASSERT_TRUE(afferent->respond({forces.data() + u * touch.steps, touch.steps}, state, response));
            // conduction delay in steps, and its integer part
            const double delay = map->afferents[first + u].delay / skin_T, steps = std::floor(delay);
            for (auto s : fired) {
                s.offset += delay - steps, s.step += static_cast<std::int64_t>(steps);
                if (s.offset > 1) s.offset -= 1, ++s.step;
                separate.push_back(s);
            }
        }
    }
    std::sort(separate.begin(), separate.end());
    ASSERT_GT(separate.size(), 1000U);
    EXPECT_EQ(spikes, separate);
}

TEST(Skin, GivesTheSameSpikesForAnyBlocksAndAfterSaveAndResume) {
    EXPECT_TRUE(rc::check([] {
        ThreadPool pool(1);
        const bool spread = *rc::gen::arbitrary<bool>();
        const auto map = small_skin(3, 4, spread, *rc::gen::element(0.0, 30.0), *rc::gen::arbitrary<bool>());
        const PressPattern touch(12, 6000, *rc::gen::arbitrary<std::uint32_t>());
        const auto expected = simulate_all(*make_skin(map), touch, pool);
        auto skin = make_skin(map);
        std::vector<Spike> spikes;
        for (std::size_t at = 0; at < touch.steps;) {
            const std::size_t steps = std::min<std::size_t>(touch.steps - at, *rc::gen::element(1, 1, 7, 31, 32, 33, 300, 1500));
            RC_ASSERT(bool(skin->respond(touch.at(at), steps, spikes, pool)));
            at += steps;
            if (*rc::gen::inRange(0, 4) > 0) continue;
            const auto saved = skin->save();
            skin = make_skin(map);
            RC_ASSERT(bool(skin->resume(saved)));
        }
        skin->finish(spikes);
        RC_ASSERT(spikes == expected);
    }));
}

TEST(Skin, GivesTheSameSpikesOnThreadsInShardsAndOnEveryInstructionSet) {
    ThreadPool one(1), three(3);
    const auto map = small_skin(16, 24, true, 30, true);
    const PressPattern touch(16 * 24, 3000, 11);
    const auto expected = simulate_all(*make_skin(map), touch, one);
    ASSERT_GT(expected.size(), 1000U);
    EXPECT_EQ(simulate_all(*make_skin(map), touch, three), expected);
    for (const auto set : instruction_sets()) EXPECT_EQ(simulate_all(*make_skin(map, set), touch, one), expected) << name_of(set);
    std::vector<Spike> merged;
    for (std::uint32_t part = 0; part < 3; ++part) {
        const auto spikes = simulate_all(*make_skin(map, *instruction_set(), {part, 3}), touch, one);
        merged.insert(merged.end(), spikes.begin(), spikes.end());
    }
    std::sort(merged.begin(), merged.end());
    EXPECT_EQ(merged, expected);
}

TEST(Skin, ANonFiniteForceIsReportedBySiteAndSample) {
    ThreadPool pool(1);
    auto skin = make_skin(small_skin(2, 2, false, 0));
    PressPattern touch(4, 100, 1);
    touch.force[2 * 100 + 40] = std::nan("");
    std::vector<Spike> spikes;
    const auto ok = skin->respond(touch.at(0), 100, spikes, pool);
    ASSERT_FALSE(ok);
    EXPECT_NE(ok.error().message.find("the force at site r2c1 is nan at sample 40"), std::string::npos) << ok.error().message;
}

TEST(Skin, RefusesAStateOfAnotherSkinOrADamagedState) {
    ThreadPool pool(1);
    const auto map = small_skin(3, 3, true, 20, true);
    auto skin = make_skin(map);
    const PressPattern touch(9, 500, 5);
    (void)simulate_all(*skin, touch, pool);
    auto saved = skin->save();
    EXPECT_FALSE(make_skin(small_skin(3, 3, false, 20))->resume(saved));
    for (std::size_t size = 0; size < saved.size(); size += 97) EXPECT_FALSE(make_skin(map)->resume(std::span(saved).first(size)));
    EXPECT_TRUE(make_skin(map)->resume(saved));
    for (std::size_t at = 0; at < saved.size(); ++at) {
        auto damaged = saved;
        damaged[at] ^= std::byte{1} << (at % 8);
        EXPECT_FALSE(make_skin(map)->resume(damaged)) << at;
    }
    saved.push_back({});
    EXPECT_FALSE(make_skin(map)->resume(saved));
}

TEST(Skin, ASpikeInTransitArrivesSoonAfterTheState) {
    const Conduction conduction(*small_skin(2, 2, false, 20), skin_T);
    constexpr auto last = std::numeric_limits<std::int64_t>::max();
    EXPECT_TRUE(conduction.can_be_in_transit({40, 0.5, 0}, 39));
    EXPECT_TRUE(conduction.can_be_in_transit({0, 0.5, 0}, -1)) << "at the start";
    EXPECT_FALSE(conduction.can_be_in_transit({39, 0.5, 0}, 39)) << "delivered";
    EXPECT_FALSE(conduction.can_be_in_transit({4000, 0.5, 0}, 39)) << "too late";
    EXPECT_FALSE(conduction.can_be_in_transit({last, 0.5, 0}, -1));
    EXPECT_TRUE(conduction.can_be_in_transit({last, 0.5, 0}, last - 1)) << "without an overflow";
    EXPECT_FALSE(conduction.can_be_in_transit({40, 0, 0}, 39)) << "a spike is after the start of its step";
}

TEST(Skin, AStateOfThePreviousVersionsIsReadAndALaterOneRefused) {
    ThreadPool pool(1);
    const auto map = small_skin(3, 3, true, 20);
    const PressPattern touch(9, 500, 5);
    auto skin = make_skin(map);
    (void)simulate_all(*skin, touch, pool);
    auto saved = skin->save();
    saved[6] = std::byte{'4'};
    const auto later = make_skin(map)->resume(saved);
    ASSERT_FALSE(later);
    EXPECT_NE(later.error().message.find("a later version than 3"), std::string::npos) << later.error().message;
    saved.resize(saved.size() - 8);
    saved[6] = std::byte{'2'};  // it has no contact waves
    ByteWriter<std::vector<std::byte>> version_2;
    version_2.put_raw(saved.data(), saved.size()), version_2.put_checksum();
    saved[6] = std::byte{'1'};  // it has no checksum, either
    for (const auto& state : {saved, version_2.take()}) {
        auto resumed = make_skin(map);
        ASSERT_TRUE(resumed->resume(state));
        EXPECT_EQ(resumed->save(), skin->save());
    }
}

}  // namespace
}  // namespace corpuscle
