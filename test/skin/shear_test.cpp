// Tangential force on a skin: afferents with preferred directions give the spikes of afferents simulated one at a time under
// F_n + gain (F_x cos phi + F_y sin phi), for any blocks, threads and instruction sets, and after a save.

#include <numbers>

#include "core/random.hpp"
#include "model/catalog.hpp"
#include "skin/skin.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

constexpr double shear_dt = 1e-3;  // s

/// Two classes with the same receptive fields, the second one without a direction, and a third one.
std::shared_ptr<const Innervation> tuned_skin(std::size_t rows, std::size_t columns, std::uint64_t seed = 7) {
    SkinPlan plan{"small", "", *grid_sites(rows, columns, 2e-3), {}, seed};
    for (const char* name : {"sa1", "fa1", "sa2"}) {
        SkinClass c{name, *plan_afferent(name)};
        c.per_site = 2, c.sigma = 1.5e-3;
        if (c.name != "fa1") c.direction.gain = c.name == "sa1" ? 0.5 : 3;
        if (c.name == "sa2") c.direction.mean = std::numbers::pi / 2, c.direction.spread = 0.3;
        plan.classes.push_back(std::move(c));
    }
    auto skin = innervate(std::move(plan));
    EXPECT_TRUE(skin) << skin.error().text();
    return *skin;
}

/// Random force with shear: some sites have only shear, some only normal force, and some none.
struct ShearTouch {
    std::size_t sites, steps;
    std::vector<double> normal, x, y;
    ShearTouch(std::size_t sites, std::size_t steps, std::uint64_t seed)
        : sites(sites), steps(steps), normal(sites * steps), x(sites * steps), y(sites * steps) {
        for (std::size_t s = 0; s < sites; ++s) {
            const auto w = philox({static_cast<std::uint32_t>(s), 0, 0, 0}, seed);
            if (w[0] % 4 == 0) continue;
            const std::size_t from = w[1] % steps, to = std::min(steps, from + w[2] % 600);
            for (std::size_t t = from; t < to; ++t) {
                const auto at = s * steps + t;
                const auto value = [&](std::uint64_t k) { return 4e-3 * static_cast<double>((w[3] + 7 * t + 1000 * k) % 2001); };
                if (w[0] % 4 != 1) normal[at] = value(0);
                if (w[0] % 4 != 2) x[at] = value(1) - 4, y[at] = value(2) - 4;
            }
        }
    }
    SiteForce at(std::size_t step) const { return {normal.data() + step, steps, {}, true, x.data() + step, y.data() + step}; }
};

std::unique_ptr<Skin> start_tuned(const std::shared_ptr<const Innervation>& skin, InstructionSet set = *instruction_set()) {
    auto made = Skin::make(skin, SimulationOptions{shear_dt}, set == InstructionSet::scalar ? InstructionSet::baseline : set);
    EXPECT_TRUE(made) << made.error().text();
    return std::move(*made);
}

std::vector<Spike> respond_to(Skin& skin, const SiteForce& force, std::size_t steps, unsigned threads = 1) {
    ThreadPool pool(threads);
    std::vector<Spike> spikes;
    const auto ok = skin.respond(force, steps, spikes, pool);
    EXPECT_TRUE(ok) << ok.error().text();
    return spikes;
}

/// The weighted sum of one component for afferent u of a class.
std::vector<double> sum_over_field(const Innervation& map, std::size_t c, std::size_t u, const std::vector<double>& component,
                                   std::size_t steps) {
    std::vector<double> out(steps);
    const auto& f = map.fields[c];
    for (std::size_t s = 0; s + 1 < f.begin.size(); ++s)
        for (auto k = f.begin[s]; k < f.begin[s + 1]; ++k)
            for (std::size_t t = 0; t < steps && f.afferent[k] == u; ++t) out[t] += f.weight[k] * component[s * steps + t];
    return out;
}

TEST(Shear, ASkinRespondsLikeItsAfferentsSimulatedSeparately) {
    const auto map = tuned_skin(4, 5);
    const ShearTouch touch(20, 3000, 3);
    std::vector<Spike> separate;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto afferent = make_afferent(map->plan.classes[c].afferent, SimulationOptions{shear_dt});
        for (std::size_t u = 0; u < 40; ++u) {
            auto force = sum_over_field(*map, c, u, touch.normal, touch.steps);
            const auto x = sum_over_field(*map, c, u, touch.x, touch.steps), y = sum_over_field(*map, c, u, touch.y, touch.steps);
            const double gain = map->plan.classes[c].direction.gain, turns = map->afferents[c * 40 + u].direction / (2 * std::numbers::pi);
            const double to_x = gain * num::cos_turns(turns), to_y = gain * num::sin_turns(turns);
            for (std::size_t t = 0; t < touch.steps; ++t) force[t] = (force[t] + to_x * x[t]) + to_y * y[t];
            auto state = afferent->start();
            ResponseBlock response{separate, static_cast<std::uint32_t>(c * 40 + u)};
            ASSERT_TRUE(afferent->respond(force, state, response));
        }
    }
    std::sort(separate.begin(), separate.end());
    ASSERT_GT(separate.size(), 500U);
    EXPECT_EQ(respond_to(*start_tuned(map), touch.at(0), touch.steps), separate);
}

TEST(Shear, GivesTheSameSpikesForAnyBlocksThreadsAndInstructionSetsAndAfterASave) {
    const auto map = tuned_skin(16, 12);
    const ShearTouch touch(16 * 12, 1200, 11);
    const auto expected = respond_to(*start_tuned(map), touch.at(0), touch.steps);
    ASSERT_GT(expected.size(), 1000U);
    EXPECT_EQ(respond_to(*start_tuned(map), touch.at(0), touch.steps, 3), expected);
    for (const auto set : instruction_sets())
        EXPECT_EQ(respond_to(*start_tuned(map, set), touch.at(0), touch.steps), expected) << name_of(set);
    auto skin = start_tuned(map);
    std::vector<Spike> spikes;
    for (std::size_t at = 0, round = 0; at < touch.steps; ++round) {
        const std::size_t steps = std::min<std::size_t>(touch.steps - at, std::array{1, 1, 31, 33, 100}[round % 5]);
        const auto some = respond_to(*skin, touch.at(at), steps);
        spikes.insert(spikes.end(), some.begin(), some.end());
        at += steps;
        const auto saved = skin->save();
        skin = start_tuned(map);
        ASSERT_TRUE(skin->resume(saved));
    }
    EXPECT_EQ(spikes, expected);
}

TEST(Shear, OfZeroNewtonsChangesNothing) {
    const auto map = tuned_skin(4, 5);
    ShearTouch touch(20, 2000, 5);
    std::fill(touch.x.begin(), touch.x.end(), 0), std::fill(touch.y.begin(), touch.y.end(), 0);
    auto without = touch.at(0);
    without.shear_x = without.shear_y = nullptr;
    const auto spikes = respond_to(*start_tuned(map), without, touch.steps);
    ASSERT_GT(spikes.size(), 100U);
    EXPECT_EQ(respond_to(*start_tuned(map), touch.at(0), touch.steps), spikes);
}

TEST(Shear, WithoutNormalForceExcitesTheAfferentsThatPreferItsDirection) {
    const auto map = tuned_skin(4, 5);
    const std::vector<double> none(20 * 1000), up(20 * 1000, 2.0);
    const SiteForce pulled{none.data(), 1000, {}, true, nullptr, up.data()};
    EXPECT_TRUE(pulled.is_touched(3, 10));
    std::array<std::size_t, 3> spikes{};
    for (const auto& s : respond_to(*start_tuned(map), pulled, 1000)) {
        ++spikes[map->afferents[s.afferent_index].class_index];
        EXPECT_GT(std::sin(map->afferents[s.afferent_index].direction), 0);
    }
    EXPECT_GT(spikes[0], 0U);
    EXPECT_EQ(spikes[1], 0U);  // no direction gain
    EXPECT_GT(spikes[2], 0U);
}

TEST(Shear, PreferredDirectionsAreDrawnAsTheClassSays) {
    const auto map = tuned_skin(20, 20);
    std::array<std::size_t, 8> octants{};
    double mean = 0, square = 0;
    for (const auto& u : map->afferents) {
        if (u.class_index == 0) ++octants[static_cast<std::size_t>(u.direction / (2 * std::numbers::pi) * 8)];
        if (u.class_index == 2) mean += u.direction / 800, square += u.direction * u.direction / 800;
    }
    for (const auto count : octants) EXPECT_NEAR(static_cast<double>(count), 100, 40);  // 4 standard deviations
    EXPECT_NEAR(mean, std::numbers::pi / 2, 4 * 0.3 / std::sqrt(800));
    EXPECT_NEAR(std::sqrt(square - mean * mean), 0.3, 4 * 0.3 / std::sqrt(1600));
    EXPECT_NE(tuned_skin(20, 20, 8)->afferents[0].direction, map->afferents[0].direction);
}

TEST(Shear, ANonFiniteShearIsReportedBySiteAndSample) {
    ShearTouch touch(4, 100, 1);
    touch.y[2 * 100 + 40] = std::nan("");
    ThreadPool pool(1);
    std::vector<Spike> spikes;
    const auto ok = start_tuned(tuned_skin(2, 2))->respond(touch.at(0), 100, spikes, pool);
    ASSERT_FALSE(ok);
    EXPECT_NE(ok.error().message.find("the shear along y at site r2c1 is nan at sample 40"), std::string::npos) << ok.error().message;
}

TEST(Shear, AStateOfASkinWithOtherDirectionsIsRefused) {
    const auto saved = start_tuned(tuned_skin(2, 2))->save();
    auto other = *tuned_skin(2, 2);
    other.afferents[0].direction += 0.1;
    EXPECT_FALSE(start_tuned(std::make_shared<const Innervation>(other))->resume(saved));
    EXPECT_TRUE(start_tuned(tuned_skin(2, 2))->resume(saved));
}

std::string error_of_class(const std::string& keys) {
    const auto plan = parse_skin_plan(
        "[sites]\nrows = 2\ncolumns = 2\npitch = \"2 mm\"\n[[class]]\nafferent = \"sa1\"\nper_site = 1\n" + keys, "skin.toml");
    return plan ? "" : plan.error().text();
}

TEST(Shear, KeysOfAClassAreReadOrRefusedWithARemedy) {
    EXPECT_EQ(error_of_class("direction_gain = 0.5\n"), "");
    EXPECT_EQ(error_of_class("direction_gain = 0.5\ndirection = \"90 deg\"\ndirection_spread = \"0.5 rad\"\n"), "");
    EXPECT_EQ(error_of_class("direction_gain = 0.5\ndirection_spread = \"uniform\"\n"), "");
    EXPECT_EQ(error_of_class("direction_gain = 0.5\ndirection = 90\ndirection_spread = 30\nsource = {direction_gain = \"choice\"}\n"), "");
    const auto has = [](const std::string& keys, const char* text) {
        EXPECT_NE(error_of_class(keys).find(text), std::string::npos) << keys << error_of_class(keys);
    };
    has("direction = 90\n", "skin.toml:8:13: a preferred direction needs a direction_gain: direction_gain = 0.5");
    has("direction_gain = -1\n", "outside [0, 100]");
    has("direction_gain = 1\ndirection = 90\ndirection_spread = \"uniform\"\n", "remove direction");
    has("direction_gain = 1\ndirection_spread = 30\n", "direction = 90");
    has("direction_gain = 1\ndirection = 400\n", "direction = 400 deg is outside [-360 deg, 360 deg]");
    has("direction_gain = 1\ndirection = \"90 mm\"\n", "direction: '90 mm' is a length; expected a value in deg, such as '2 deg'");
    has("direction_gain = 1\ndirection = \"up\"\n", "direction");
}

}  // namespace
}  // namespace corpuscle
