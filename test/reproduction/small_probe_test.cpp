// The small probe of the study nerve against the complete simulation of a skin.

#include "reproduction/skin/small_probe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/stimulus/stimuli.hpp"
#include "run/skin/skin_force.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

/// The number of spikes of each afferent while the probe presses with this force at a site.
std::vector<int> press(const std::shared_ptr<const Innervation>& skin, std::uint32_t site, double force) {
    const auto& at = skin->plan.sites.positions[site];
    const std::vector<std::string> settings = {fmt::format("ramp-hold.F_max={}", force),
                                               fmt::format("ramp-hold.t_up={}", probe_ramp),
                                               fmt::format("ramp-hold.t_hold={}", probe_hold),
                                               "ramp-hold.t_rest=0",
                                               "ramp-hold.t_down=0",
                                               "ramp-hold.t_post=0",
                                               fmt::format("contact.radius={}", probe_radius),
                                               fmt::format("contact.x={}", at.x),
                                               fmt::format("contact.y={}", at.y)};
    const auto overrides = test::value_or_throw(parse_overrides(settings));
    auto source = test::value_or_throw(make_stimulus("ramp-hold", overrides, probe_rate, 0));
    auto contact = test::value_or_throw(make_contact("sphere", overrides, skin->plan.sites, source.result->clock()));
    const auto pressed = make_pressed_force(*source.result, *contact.result);
    const auto simulation = test::value_or_throw(Skin::make(skin, {.dt = 1 / probe_rate}, *instruction_set()));
    ThreadPool pool(1);
    std::vector<Spike> spikes;
    for (;;) {
        const auto block = test::value_or_throw(pressed->next());
        if (block.total_force.empty()) break;
        const auto done = simulation->respond(block.force, block.total_force.size(), spikes, pool);
        EXPECT_TRUE(done);
    }
    simulation->finish(spikes);
    std::vector<int> out(skin->afferents.size());
    for (const auto& s : spikes) ++out[s.afferent_index];
    return out;
}

/// The built-in fingertip with a tenth of its afferents.
std::shared_ptr<const Innervation> fingertip() {
    auto plan = test::value_or_throw(load_skin_plan("fingertip"));
    plan.nerve.reset();  // no conduction delay
    for (auto& c : plan.classes)
        for (auto& density : c.density) density /= 10;
    return test::value_or_throw(innervate(std::move(plan)));
}

TEST(SmallProbe, LeastForcesAreThoseOfTheCompleteSkin) {
    const auto skin = fingertip();
    const auto classes = test::value_or_throw(probe_skin(*skin, 0));
    ASSERT_EQ(classes.size(), skin->plan.classes.size());
    for (std::size_t c = 0; c < classes.size(); ++c) {
        const auto& p = classes[c];
        ASSERT_GE(p.units.size(), 2u);
        for (std::size_t k = 0; k < p.units.size(); k += p.units.size() / 2) {
            const auto unit = skin->class_begin[c] + p.units[k];
            ASSERT_FALSE(std::isnan(p.least_force[k])) << skin->afferent_name(unit);
            EXPECT_GT(press(skin, p.site[k], 1.05 * p.least_force[k])[unit], 0) << skin->afferent_name(unit);
            EXPECT_EQ(press(skin, p.site[k], 0.95 * p.least_force[k])[unit], 0) << skin->afferent_name(unit);
        }
    }
}

TEST(SmallProbe, AFieldHasTheSitesAtWhichFourTimesTheLeastForceEvokesASpike) {
    const auto skin = fingertip();
    const auto p = test::value_or_throw(probe_skin(*skin, 1)).front();  // SA-I, which feel no wave
    ASSERT_EQ(p.field_area.size(), 1u);
    const auto& at = skin->plan.sites.positions;
    int sites = 0;
    for (std::uint32_t s = 0; s < skin->plan.sites.size(); ++s)
        if (std::hypot(at[s].x - at[p.site[0]].x, at[s].y - at[p.site[0]].y) < 3e-3)
            sites += press(skin, s, 4 * p.least_force[0])[p.units[0]] > 0;
    EXPECT_GT(sites, 0);
    EXPECT_NEAR(p.field_area[0] / skin->plan.sites.area, sites, 1e-6);
}

}  // namespace
}  // namespace corpuscle
