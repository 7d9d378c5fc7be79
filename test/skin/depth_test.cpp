// Receptive fields as stress at a depth, and hot spots with receptors of their own.

#include <cmath>

#include "model/lane_population.hpp"
#include "skin/depth_kernel.hpp"
#include "skin/skin.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

/// The receptive field of each receptor of a class, as the weight of each site.
std::vector<std::vector<double>> fields_by_receptor(const Innervation& skin, std::size_t class_index) {
    const auto& f = skin.fields[class_index];
    std::vector<std::vector<double>> out((skin.class_begin[class_index + 1] - skin.class_begin[class_index]) * f.receptors,
                                         std::vector<double>(skin.plan.sites.size()));
    for (std::size_t s = 0; s + 1 < f.begin.size(); ++s)
        for (auto k = f.begin[s]; k < f.begin[s + 1]; ++k) out[f.afferent[k]][s] = f.weight[k];
    return out;
}

/// A square of skin with side * side sites, and one class.
SkinPlan square(std::size_t side, double pitch, double depth) {
    SkinPlan plan{"square", "", *grid_sites(side, side, pitch), {}, 3};
    plan.sites.area = pitch * pitch, plan.felt_area = 1e-4;
    SkinClass c{"fa1", *plan_afferent("fa1")};
    c.per_site = 1, c.depth = depth;
    plan.classes = {c};
    return plan;
}

/// Boussinesq's kernel for a point.
double point_stress(double x, double y, double z) { return 3 * z * z * z / (2 * M_PI * std::pow(x * x + y * y + z * z, 2.5)); }

TEST(DepthKernel, IsTheIntegralOfThePointKernel) {
    EXPECT_TRUE(rc::check([] {
        const double z = *rc::gen::inRange(3, 20) * 1e-4, x = *rc::gen::inRange(-40, 40) * 1e-4, y = *rc::gen::inRange(-40, 40) * 1e-4;
        constexpr int steps = 400;
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) sum += point_stress((i + 0.5) / steps * x, (j + 0.5) / steps * y, z);
        RC_ASSERT(std::abs(sum * x * y / steps / steps - DepthKernel(z).corner(x, y)) < 1e-4);
    }));
}

TEST(DepthKernel, LeavesAFractionOutsideItsReach) {
    const DepthKernel kernel(1e-3);
    for (const double fraction : {0.3, 0.05, 0.01}) {
        const double reach = kernel.reach(fraction);
        EXPECT_NEAR(4 * kernel.corner(reach, reach), 1 - fraction, 1e-9);
    }
    EXPECT_NEAR(4 * kernel.corner(1e3, 1e3), 1, 1e-6);
}

TEST(DepthField, IsTheStressBelowTheCellOfEachSite) {
    const double pitch = 1e-3, depth = 0.6e-3;
    const auto skin = *innervate(square(15, pitch, depth));
    const auto field = fields_by_receptor(*skin, 0)[7 * 15 + 7];  // of the afferent in the middle
    const auto& at = skin->plan.sites.positions;
    double largest = 0;
    for (std::size_t s = 0; s < field.size(); ++s) {
        double cell = 0;
        constexpr int steps = 40;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j)
                cell += point_stress(at[s].x - at[112].x + ((i + 0.5) / steps - 0.5) * pitch,
                                     at[s].y - at[112].y + ((j + 0.5) / steps - 0.5) * pitch, depth);
        const double expected = cell * pitch * pitch / steps / steps * 1e-4 / (pitch * pitch);
        EXPECT_NEAR(field[s], expected, 0.012 * expected + 1e-9 + (field[s] == 0 ? 0.01 * 100 : 0)) << s;
        largest = std::max(largest, field[s]);
    }
    EXPECT_EQ(largest, field[112]);
}

TEST(DepthField, FeelsAnEvenPressureAsTheForceOnTheFeltAreaLessTheSurround) {
    for (const double surround : {0.0, 0.3, 1.0})
        for (const bool per_spot : {false, true}) {
            auto plan = square(20, 0.5e-3, 0.6e-3);
            auto& c = plan.classes[0];
            c.surround = surround, c.hot_spots = 4, c.hot_spot_spread = 1e-3, c.receptor_per_hot_spot = per_spot;
            const auto fields = fields_by_receptor(**innervate(plan), 0);
            EXPECT_EQ(fields.size(), 400U * (per_spot ? 4 : 1));
            for (const auto& f : fields) {
                double felt = 0;  // N, under a pressure of 4 N on 1 cm2
                for (const double w : f) felt += w * 4e4 * 0.25e-6;
                ASSERT_NEAR(felt, 4 * (1 - surround), 1e-9);
            }
        }
}

TEST(DepthField, WithASurroundFeelsAnEdgeMoreThanAnEvenPressure) {
    auto plan = square(40, 0.5e-3, 0.6e-3);
    plan.classes[0].surround = 0.5;
    const auto skin = *innervate(plan);
    const auto fields = fields_by_receptor(*skin, 0);
    const auto& at = skin->plan.sites.positions;
    const double edge = 10e-3;
    std::vector<double> felt;  // along the middle row, under a pressure of 4 N on 1 cm2 right of the edge
    for (std::size_t u = 20 * 40; u < 21 * 40; ++u) {
        felt.push_back(0);
        for (std::size_t s = 0; s < at.size(); ++s) felt.back() += at[s].x > edge ? fields[u][s] * 4e4 * 0.25e-6 : 0;
    }
    const auto peak = std::max_element(felt.begin(), felt.end());
    EXPECT_GT(*peak, 1.1 * 2.0) << "2 N is felt far from the edge";
    EXPECT_NEAR(at[static_cast<std::size_t>(peak - felt.begin())].x, edge, 1.5e-3);
    EXPECT_NEAR(felt[36], 2, 0.05);
    EXPECT_LT(*std::min_element(felt.begin(), felt.end()), -0.1) << "the pressure in the surround alone";
}

TEST(DepthField, OfAHotSpotIsPartOfThatOfOneReceptor) {
    auto plan = square(20, 0.5e-3, 0.3e-3);
    plan.classes[0].hot_spots = 5, plan.classes[0].hot_spot_spread = 0.5e-3;
    const auto one = fields_by_receptor(**innervate(plan), 0);
    plan.classes[0].receptor_per_hot_spot = true;
    const auto each = fields_by_receptor(**innervate(plan), 0);
    const std::size_t u = 10 * 20 + 10;  // far from the edges of the skin
    for (std::size_t s = 0; s < one[u].size(); ++s) {
        double mean = 0;
        for (std::size_t h = 0; h < 5; ++h) mean += each[5 * u + h][s] / 5;
        ASSERT_NEAR(mean, one[u][s], 0.01 * 400) << s;
        if (one[u][s] > 1) {
            ASSERT_NEAR(mean / one[u][s], 1, 0.02) << s;
        }
    }
}

/// A skin whose afferents have a receptor for each hot spot, with negative weights from the surround.
std::shared_ptr<const Innervation> hot_spot_skin() {
    auto plan = square(12, 1e-3, 0.3e-3);
    plan.felt_area = 4e-6;
    auto slow = plan.classes[0];
    plan.classes[0].hot_spots = 4, plan.classes[0].hot_spot_spread = 0.8e-3, plan.classes[0].receptor_per_hot_spot = true;
    slow.name = "sa1", slow.afferent = *plan_afferent("sa1"), slow.depth = 0.6e-3, slow.surround = 0.6;
    slow.hot_spots = 3, slow.hot_spot_spread = 0.5e-3, slow.receptor_per_hot_spot = true;
    slow.distributions.push_back({"sa1", "V_th", "V", 0.03, {}});
    plan.classes.push_back(slow);
    return *innervate(std::move(plan));
}

/// Random presses on the sites, with long times without force.
std::vector<double> presses(std::size_t sites, std::size_t steps) {
    std::vector<double> force(sites * steps);
    for (std::size_t s = 0; s < sites; s += 3)
        for (std::size_t t = s * 37 % 900; t < 400 + s * 37 % 900; ++t)
            force[s * steps + t] = 1 + std::sin(static_cast<double>(t * (s + 1)) / 40);
    return force;
}

std::unique_ptr<Skin> make_simulation(const std::shared_ptr<const Innervation>& map, InstructionSet set, SkinPart part = {}) {
    return test::value_or_throw(Skin::make(map, {1e-3}, set, part));
}

std::vector<Spike> respond(Skin& skin, const std::vector<double>& force, std::size_t steps, unsigned threads) {
    ThreadPool pool(threads);
    std::vector<Spike> out;
    EXPECT_TRUE(skin.respond({force.data(), steps}, steps, out, pool));
    skin.finish(out);
    return out;
}

TEST(HotSpots, WithReceptorsRespondLikePopulationsWithTheirForces) {
    const auto map = hot_spot_skin();
    const std::size_t steps = 5000;
    const auto force = presses(144, steps);
    auto skin = make_simulation(map, InstructionSet::baseline);
    const auto spikes = respond(*skin, force, steps, 1);
    EXPECT_GT(skin->stats().skipped_steps, 0);
    std::vector<Spike> expected;
    for (std::size_t c = 0; c < 2; ++c) {
        const auto& plan = map->plan.classes[c];
        const auto fields = fields_by_receptor(*map, c);
        std::vector<std::vector<double>> felt(fields.size(), std::vector<double>(steps));
        std::vector<const double*> columns;
        for (std::size_t k = 0; k < fields.size(); ++k) {
            for (std::size_t s = 0; s < 144; s += 3)  // the sites with force
                for (std::size_t t = 0; t < steps && fields[k][s] != 0; ++t) felt[k][t] += fields[k][s] * force[s * steps + t];
            columns.push_back(felt[k].data());
        }
        const auto plans = test::value_or_throw(make_copies(plan.afferent, 144, plan.distributions, map->plan.seed));
        std::vector<const AfferentPlan*> each;
        for (const auto& p : plans) each.push_back(&p);
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t u = 0; u < 144; ++u) numbers.push_back(static_cast<std::uint32_t>(144 * c) + u);
        const auto population = test::value_or_throw(make_lane_population(
            {.plans = each, .size = 144, .afferent_numbers = numbers, .forces = plan.receptors()}, {1e-3}, InstructionSet::baseline));
        ThreadPool pool(1);
        PopulationResponse response{&expected};
        ASSERT_TRUE(population->respond(ForceColumns{columns}, steps, response, pool));
    }
    std::sort(expected.begin(), expected.end());
    ASSERT_GT(expected.size(), 1000U);
    EXPECT_EQ(spikes, expected);
}

TEST(HotSpots, WithReceptorsGiveTheSameSpikesForBlocksThreadsShardsInstructionSetsAndAfterResuming) {
    const auto map = hot_spot_skin();
    const std::size_t steps = 3000;
    const auto force = presses(144, steps);
    const auto expected = respond(*make_simulation(map, InstructionSet::baseline), force, steps, 1);
    for (const auto set : instruction_sets().subspan(1))
        EXPECT_EQ(respond(*make_simulation(map, set), force, steps, 3), expected) << name_of(set);
    for (const std::size_t block : {1, 31, 500}) {
        auto skin = make_simulation(map, InstructionSet::baseline);
        ThreadPool pool(1);
        std::vector<Spike> out;
        for (std::size_t at = 0; at < steps; at += block) {
            ASSERT_TRUE(skin->respond({force.data() + at, steps}, std::min(block, steps - at), out, pool));
            if (at / block % 50 != 0) continue;
            const auto saved = skin->save();
            skin = make_simulation(map, InstructionSet::baseline);
            ASSERT_TRUE(skin->resume(saved));
        }
        skin->finish(out);
        EXPECT_EQ(out, expected) << block;
    }
    std::vector<Spike> merged;
    for (std::uint32_t part = 0; part < 3; ++part) {
        const auto spikes = respond(*make_simulation(map, InstructionSet::baseline, {part, 3}), force, steps, 1);
        merged.insert(merged.end(), spikes.begin(), spikes.end());
    }
    std::sort(merged.begin(), merged.end());
    EXPECT_EQ(merged, expected);
}

TEST(HotSpots, WithEqualForcesFeelShearAndWavesAsOneReceptorDoes) {
    // Two hot spots at the same site: the mean of two equal currents is this current, to the bit.
    auto plan = square(12, 1e-3, 0);
    auto& c = plan.classes[0];
    plan.felt_area = 4e-6;
    c.sigma = 1e-4, c.hot_spots = 2, c.hot_spot_spread = 1e-9;
    c.direction.gain = 0.5, c.wave.speed = 5;
    const std::size_t steps = 2000;
    const auto normal_force = presses(144, steps);
    auto shear = normal_force;
    for (std::size_t k = 0; k < shear.size(); ++k) shear[k] *= std::sin(static_cast<double>(k) / 50);
    std::vector<std::vector<Spike>> spikes;
    for (const bool per_spot : {false, true}) {
        c.receptor_per_hot_spot = per_spot;
        const auto skin = make_simulation(*innervate(plan), InstructionSet::baseline);
        ThreadPool pool(2);
        spikes.emplace_back();
        SiteForce force{normal_force.data(), steps};
        force.shear_x = shear.data();
        ASSERT_TRUE(skin->respond(force, steps, spikes.back(), pool));
    }
    EXPECT_GT(spikes[0].size(), 1000U);
    EXPECT_EQ(spikes[0], spikes[1]);
}

TEST(HotSpots, WithReceptorsFollowAGratingOfTwoMillimetresThatTheirMeanAveragesOut) {
    // A grating that slides over the skin along x, at 40 mm/s.
    auto plan = square(24, 0.5e-3, 0.3e-3);
    plan.classes[0].hot_spots = 8, plan.classes[0].hot_spot_spread = 1e-3;
    const std::size_t steps = 1000, sites = plan.sites.size();
    std::vector<double> force(sites * steps);
    for (std::size_t s = 0; s < sites; ++s)
        for (std::size_t t = 0; t < steps; ++t)
            force[s * steps + t] =
                1e-2 * (1 + std::cos(2 * M_PI * (plan.sites.positions[s].x - 40e-3 * 1e-3 * static_cast<double>(t)) / 2e-3));
    const auto one = respond(*make_simulation(*innervate(plan), InstructionSet::baseline), force, steps, 1).size();
    plan.classes[0].receptor_per_hot_spot = true;
    const auto each = respond(*make_simulation(*innervate(plan), InstructionSet::baseline), force, steps, 1).size();
    EXPECT_GT(each, 3 * one);
    EXPECT_GT(each, 10 * sites);
}

}  // namespace
}  // namespace corpuscle
