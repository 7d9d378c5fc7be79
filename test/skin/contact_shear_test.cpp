// Shear under an indenter: the total of a tilted force, the closed forms of Cattaneo and Mindlin for a movement that begins, and full
// sliding.

#include <cmath>

#include "skin/contact/contact.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

constexpr double sheared_pitch = 0.25e-3;  // m

/// A square of skin of 24 mm without gaps, its middle at (0, 0).
Sites sheared_sheet() {
    constexpr std::size_t n = 97;
    auto sites = *grid_sites(n, n, sheared_pitch);
    for (auto& p : sites.positions) p.x -= 48 * sheared_pitch, p.y -= 48 * sheared_pitch;
    sites.area = sheared_pitch * sheared_pitch;
    return sites;
}

Result<Applied<std::unique_ptr<Contact>>> sheared_contact(std::string_view indenter, const std::vector<std::string>& settings,
                                                          const Sites& sites) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : settings) overrides.push_back(*parse_override("contact." + text));
    return make_contact(indenter, overrides, sites, *make_clock(1000));
}

/// Force at each site in the last sample of a block.
struct ShearMap {
    std::vector<double> normal, x, y;
    double total_normal = 0, total_x = 0, total_y = 0;
    ShearMap(Contact& contact, std::size_t sites, const std::vector<double>& force, std::int64_t first = 0)
        : normal(sites), x(sites), y(sites) {
        const auto pressed = contact.press(force, first);
        EXPECT_TRUE(pressed) << pressed.error().text();
        for (const auto s : pressed->touched) {
            const auto at = s * pressed->stride + force.size() - 1;
            normal[s] = pressed->data[at], total_normal += normal[s];
            if (!pressed->has_shear()) continue;
            x[s] = pressed->shear_x[at], y[s] = pressed->shear_y[at], total_x += x[s], total_y += y[s];
        }
    }
};

TEST(ContactShear, OfATiltedForceIsSpreadLikeThePressure) {
    const auto sites = sheared_sheet();
    for (const char* indenter : {"flat", "sphere", "edge", "grating"}) {
        const auto contact = std::move(sheared_contact(indenter, {"tilt=20", "azimuth=90"}, sites)->result);
        const ShearMap map(*contact, sites.size(), {2.0});
        const double tangent = std::tan(20 * 3.141592653589793 / 180);
        EXPECT_NEAR(map.total_y, 2 * tangent, 1e-9) << indenter;
        for (std::size_t s = 0; s < sites.size(); ++s) {
            EXPECT_NEAR(map.y[s], tangent * map.normal[s], 1e-12) << indenter;
            EXPECT_NEAR(map.x[s], 0, 1e-12) << indenter;
        }
    }
}

TEST(ContactShear, WithoutTiltOrFrictionThereIsNone) {
    const auto sites = sheared_sheet();
    const auto contact = std::move(sheared_contact("sphere", {"x1=5mm", "speed=10mm/s"}, sites)->result);
    EXPECT_FALSE(contact->press(std::vector{1.0}, 0)->has_shear());
}

/// A sphere of 8 mm with 1 N moves along x at 10 mm/s with a friction of 0.5, so it has moved by 10 um times the sample.
constexpr double sphere_R = 8e-3, sphere_E = 100e3, sphere_mu = 0.5;
const std::vector<std::string> sliding_sphere = {"radius=8mm", "x=0", "y=0", "x1=5mm", "speed=10mm/s", "friction=0.5"};

TEST(ContactShear, OfASphereThatBeginsToMoveIsThatOfCattaneoAndMindlin) {
    const auto sites = sheared_sheet();
    const double a = std::cbrt(3 * sphere_R / (4 * sphere_E)),
                 full = 1.5 * sphere_mu * a * a / sphere_R;  // m; full: displacement at which all of it slips
    for (const std::int64_t moved : {20, 60, 100}) {         // in 10 um
        const auto contact = std::move(sheared_contact("sphere", sliding_sphere, sites)->result);
        const ShearMap before(*contact, sites.size(), {1.0}, 0);
        EXPECT_EQ(before.total_x, 0);
        const ShearMap map(*contact, sites.size(), {1.0}, moved);
        const double s = 1e-5 * static_cast<double>(moved), c = a * std::sqrt(1 - s / full);
        EXPECT_NEAR(map.total_x, sphere_mu * (1 - std::pow(1 - s / full, 1.5)), 1e-4) << moved;
        for (std::size_t k = 0; k < sites.size(); ++k) {
            const double r = std::hypot(sites.positions[k].x - s, sites.positions[k].y);
            if (r > a - sheared_pitch) continue;
            if (r > c + sheared_pitch) {
                EXPECT_NEAR(map.x[k], sphere_mu * map.normal[k], 1e-12) << moved;
            }
            if (r < c - sheared_pitch) {
                EXPECT_LT(map.x[k], sphere_mu * map.normal[k]) << moved;
            }
        }
    }
}

TEST(ContactShear, OfASlidingSphereIsFrictionTimesPressure) {
    const auto sites = sheared_sheet();
    const auto contact = std::move(sheared_contact("sphere", sliding_sphere, sites)->result);
    (void)ShearMap(*contact, sites.size(), {1.0}, 0);
    const ShearMap map(*contact, sites.size(), {1.0}, 400);
    for (std::size_t s = 0; s < sites.size(); ++s) EXPECT_NEAR(map.x[s], sphere_mu * map.normal[s], 1e-15);
    EXPECT_NEAR(map.total_x, sphere_mu * map.total_normal, 1e-12);
}

/// An indenter that has stopped half way to full sliding is lifted.
TEST(ContactShear, IsReleasedFromTheEdgeInwardsWhenTheContactIsLifted) {
    const auto sites = sheared_sheet();
    const auto contact =
        std::move(sheared_contact("sphere", {"radius=8mm", "x=0", "y=0", "x1=0.7mm", "speed=10mm/s", "friction=0.5"}, sites)->result);
    (void)ShearMap(*contact, sites.size(), {1.0}, 0);
    double last_stuck = 1e9;
    for (const double force : {1.0, 0.7, 0.5, 0.3}) {
        const ShearMap map(*contact, sites.size(), {force}, 1000);
        double stuck = 0;  // m; largest radius at which the shear is below friction
        for (std::size_t s = 0; s < sites.size(); ++s)
            if (map.normal[s] > 0 && map.x[s] < sphere_mu * map.normal[s] * (1 - 1e-9))
                stuck = std::max(stuck, std::hypot(sites.positions[s].x - 0.7e-3, sites.positions[s].y));
        EXPECT_LT(stuck, last_stuck) << force;
        EXPECT_LE(map.total_x, sphere_mu * force * (1 + 1e-9));
        last_stuck = stuck;
    }
    const ShearMap nearly_off(*contact, sites.size(), {0.01}, 1001);
    EXPECT_NEAR(nearly_off.total_x, sphere_mu * 0.01, 1e-9);  // all of it slips
    (void)ShearMap(*contact, sites.size(), {0.0}, 1002);
    EXPECT_EQ(ShearMap(*contact, sites.size(), {1.0}, 1003).total_x, 0);  // a new contact, which does not move
}

TEST(ContactShear, OfAFlatPunchGrowsWithItsStiffnessAndThenSlidesAtOnce) {
    const auto sites = sheared_sheet();
    const auto contact = std::move(
        sheared_contact("flat", {"radius=4mm", "x=0", "y=0", "x1=0", "y1=-5mm", "speed=10mm/s", "friction=0.5", "E_star=50kPa"}, sites)
            ->result);
    (void)ShearMap(*contact, sites.size(), {1.0}, 0);
    const ShearMap map(*contact, sites.size(), {1.0}, 100);
    EXPECT_NEAR(map.total_y, -4.0 / 3 * 4e-3 * 50e3 * 1e-3, 1e-9);  // 8 G a s / (2 - nu)
    EXPECT_NEAR(ShearMap(*contact, sites.size(), {1.0}, 300).total_y, -0.5, 1e-9);
}

TEST(ContactShear, OfAPassingGratingIsAlongItsMovement) {
    const auto sites = sheared_sheet();
    const auto contact = std::move(sheared_contact("grating", {"speed=10mm/s", "friction=0.3", "angle=90"}, sites)->result);
    (void)ShearMap(*contact, sites.size(), {1.0}, 0);
    const ShearMap map(*contact, sites.size(), {1.0}, 50);
    EXPECT_NEAR(map.total_y, 0.3 * map.total_normal, 1e-9);
    EXPECT_NEAR(map.total_x, 0, 1e-9);
}

TEST(ContactShear, IsTheSameForAnyBlocks) {
    const auto sites = sheared_sheet();
    const std::vector<double> force(64, 0.8);
    const auto whole = std::move(sheared_contact("sphere", sliding_sphere, sites)->result),
               parts = std::move(sheared_contact("sphere", sliding_sphere, sites)->result);
    const ShearMap expected(*whole, sites.size(), force);
    for (std::int64_t k = 0; k < 63; ++k) (void)ShearMap(*parts, sites.size(), {0.8}, k);
    EXPECT_EQ(ShearMap(*parts, sites.size(), {0.8}, 63).x, expected.x);
}

TEST(ContactShear, OfTheForceItselfIsSpreadLikeThePressure) {
    const auto sites = sheared_sheet();
    const auto contact = std::move(sheared_contact("sphere", {}, sites)->result);
    const std::vector<double> force = {2, 2}, x = {0.5, -0.5}, y = {0, 1};
    const auto pressed = contact->press(force, 0, x, y);
    ASSERT_TRUE(pressed && pressed->has_shear());
    double total_y = 0;
    for (const auto s : pressed->touched) {
        const auto at = s * pressed->stride + 1;
        EXPECT_NEAR(pressed->shear_x[at], -0.25 * pressed->data[at], 1e-15);
        total_y += pressed->shear_y[at];
    }
    EXPECT_NEAR(total_y, 1, 1e-9);
    const auto tilted = sheared_contact("sphere", {"tilt=10"}, sites)->result->press(force, 0, x, y);
    ASSERT_FALSE(tilted);
    EXPECT_NE(tilted.error().text().find("remove contact.tilt"), std::string::npos);
}

TEST(ContactShear, ContradictorySettingsAreRefusedWithARemedy) {
    const auto sites = sheared_sheet();
    const auto has = [&](std::string_view indenter, const std::vector<std::string>& settings, const char* text) {
        const auto made = sheared_contact(indenter, settings, sites);
        ASSERT_FALSE(made) << text;
        EXPECT_NE(made.error().text().find(text), std::string::npos) << made.error().text();
    };
    has("flat", {"azimuth=90"}, "give contact.tilt, such as contact.tilt=20");
    has("sphere", {"tilt=30", "friction=0.5"}, "friction of at least 0.578");
    has("sphere", {"friction=0.5"}, "has no effect");
    has("sphere", {"tilt=10", "friction=0.5", "x1=5mm", "speed=1mm/s"}, "give only one of them");
    has("flat", {"E_star=10kPa"}, "remove it, or give contact.friction");
    has("flat", {"tilt=85"}, "outside [0, 80]");
}

}  // namespace
}  // namespace corpuscle
