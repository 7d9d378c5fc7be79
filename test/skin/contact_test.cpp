// Contact mechanics: the forces at the sites add up to the force on the indenter, match the pressures of textbooks and follow the path of
// the indenter.

#include <cmath>
#include <cstring>
#include <numeric>

#include "skin/contact/contact.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

/// A square of skin without gaps, with sites every `pitch` (m) from (-half, -half) to (half, half) (m). The centre of one site is at (0,
/// 0).
Sites sheet(double half, double pitch) {
    const auto n = 2 * static_cast<std::size_t>(std::lround(half / pitch)) + 1;
    auto sites = *grid_sites(n, n, pitch);
    for (auto& p : sites.positions) p.x -= static_cast<double>(n / 2) * pitch, p.y -= static_cast<double>(n / 2) * pitch;
    sites.area = pitch * pitch;
    return sites;
}

/// A contact with settings such as "radius=4mm"; an error fails the test.
std::unique_ptr<Contact> make_checked_contact(std::string_view indenter, std::initializer_list<const char*> settings, const Sites& sites,
                                              double rate = 1000) {
    std::vector<ParameterOverride> overrides;
    for (const std::string text : settings) overrides.push_back(*parse_override("contact." + text));
    auto made = make_contact(indenter, overrides, sites, *make_clock(rate));
    EXPECT_TRUE(made) << made.error().text();
    return std::move(made->result);
}

/// The force (N) at each site if the indenter is pressed with `force` (N) at sample `at`.
std::vector<double> force_map(Contact& contact, const Sites& sites, double force, std::int64_t at = 0) {
    const auto pressed = contact.press({&force, 1}, at);
    EXPECT_TRUE(pressed) << pressed.error().text();
    std::vector<double> out(sites.size(), 0.0);
    for (const auto s : pressed->touched) out[s] = pressed->data[s * pressed->stride];
    return out;
}

double sum(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

/// Total force (N) at the sites that are less than `reach` (m) from the centre.
double within(const std::vector<double>& map, const Sites& sites, double reach) {
    double out = 0;
    for (std::size_t s = 0; s < map.size(); ++s) out += std::hypot(sites.positions[s].x, sites.positions[s].y) < reach ? map[s] : 0;
    return out;
}

Position centroid(const std::vector<double>& map, const Sites& sites) {
    Position out;
    for (std::size_t s = 0; s < map.size(); ++s)
        out.x += map[s] * sites.positions[s].x / sum(map), out.y += map[s] * sites.positions[s].y / sum(map);
    return out;
}

RC_GTEST_PROP(Contacts, DistributeAllOfTheForce, ()) {
    const auto sites = sheet(20e-3, 1e-3);
    const auto indenter = *rc::gen::element<std::string>("flat", "sphere", "edge", "grating");
    std::vector<ParameterOverride> overrides;
    const auto add_override = [&](const char* name, int low, int high, double scale) {
        overrides.push_back({"contact", name, std::to_string(*rc::gen::inRange(low, high) * scale)});
    };
    add_override("x", -500, 500, 1e-5), add_override("y", -500, 500, 1e-5);
    if (indenter == "edge" || indenter == "grating") add_override("angle", -180, 180, 1);
    if (indenter != "edge") add_override("radius", 1, 80, 1e-4);
    if (indenter == "edge") add_override("length", 1, 150, 1e-4);
    const double force = *rc::gen::inRange(1, 4000) * 1e-3;
    auto contact = make_contact(indenter, overrides, sites, *make_clock(1000));
    RC_ASSERT(bool(contact));
    const double total_force = sum(force_map(*contact->result, sites, force));
    RC_ASSERT(std::abs(total_force - force) < 1e-12 ||
              (indenter == "grating" && total_force == 0));  // a small contact may lie over a groove, where there is no force
}

TEST(Contacts, LoseTheForceOffTheSkinAndReportIt) {
    const auto sites = sheet(10e-3, 1e-3);
    for (const auto* indenter : {"flat", "sphere", "edge", "grating"}) {
        const auto contact = make_checked_contact(indenter, {"x=10.5mm", "y=0mm"}, sites);  // exactly at the edge of the skin
        EXPECT_NEAR(sum(force_map(*contact, sites, 2)), 1, std::string(indenter) == "grating" ? 0.2 : 1e-9) << indenter;
        const auto notes = contact->notes();
        EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const auto& r) {
            return r.find("% of the force, over time, was off the skin") != r.npos;
        })) << indenter;
    }
    EXPECT_EQ(sum(force_map(*make_checked_contact("sphere", {"x=1m", "y=0"}, sites), sites, 1)), 0);
    EXPECT_EQ(sum(force_map(*make_checked_contact("sphere", {}, sites), sites, -1)), 0);
}

TEST(Contacts, DistributeAllOfTheForceOverIrregularSites) {
    auto sites = *grid_sites(4, 5, 3e-3);
    for (std::size_t s = 0; s < sites.size(); ++s) sites.positions[s].x += 0.3e-3 * static_cast<double>(s % 3);
    const auto contact = make_checked_contact("flat", {"radius=4mm", "x=6mm", "y=4mm"}, sites);
    EXPECT_NEAR(sum(force_map(*contact, sites, 3)), 3, 1e-12);
    EXPECT_NE(contact->notes()[1].find("not on a lattice"), std::string::npos);
}

TEST(Contacts, AreAsSymmetricAsTheirIndenters) {
    const auto sites = sheet(8e-3, 0.5e-3);
    const std::size_t n = 33;
    for (const auto* indenter : {"flat", "sphere", "edge"}) {
        const auto map = force_map(*make_checked_contact(indenter, {"x=0", "y=0"}, sites), sites, 1);
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t c = 0; c < n; ++c) {
                const double here = map[r * n + c];
                ASSERT_NEAR(here, map[r * n + (n - 1 - c)], 1e-12) << indenter;
                ASSERT_NEAR(here, map[(n - 1 - r) * n + c], 1e-12) << indenter;
            }
    }
}

// Radius a, pressure p0 at the centre and force within a radius: Johnson, Contact Mechanics.
TEST(Sphere, ConvergesToHertzsRadiusAndPressureAsThePitchDecreases) {
    const double F = 1, R = 8e-3, E = 60e3, a = std::cbrt(3 * F * R / (4 * E)), p0 = 3 * F / (2 * M_PI * a * a);
    double before = 1;
    for (const double pitch : {1e-3, 0.5e-3, 0.25e-3}) {
        const auto sites = sheet(8e-3, pitch);
        const auto map = force_map(*make_checked_contact("sphere", {"radius=8mm", "E_star=60kPa", "x=0", "y=0"}, sites), sites, F);
        const double middle = *std::max_element(map.begin(), map.end()) / (pitch * pitch);
        const double error = std::abs(middle / p0 - 1);
        EXPECT_LT(error, 0.4 * before);  // it decreases with the square of the pitch, apart from the quadrature error
        before = error;
        double far = 0;  // largest x of a site with force, m
        for (std::size_t s = 0; s < map.size(); ++s) far = map[s] > 0 ? std::max(far, sites.positions[s].x) : far;
        EXPECT_NEAR(far, a, pitch);
        EXPECT_NEAR(within(map, sites, 0.6 * a), F * (1 - std::pow(1 - 0.36, 1.5)), 0.15 * pitch / 1e-3 + 0.005);
    }
    EXPECT_LT(before, 0.005);
}

TEST(Flat, HasItsMaximumPressureAtItsRim) {
    const double F = 2, a = 4e-3;
    for (const double pitch : {0.5e-3, 0.1e-3}) {
        const auto sites = sheet(5e-3, pitch);
        const auto map = force_map(*make_checked_contact("flat", {"radius=4mm", "x=0", "y=0"}, sites), sites, F);
        EXPECT_NEAR(map[map.size() / 2] / (pitch * pitch), F / (2 * M_PI * a * a), 0.01 * F / (2 * M_PI * a * a));
        for (const double r : {0.5, 0.8})  // fractions of the radius
            EXPECT_NEAR(within(map, sites, r * a), F * (1 - std::sqrt(1 - r * r)), 100 * F * pitch);
        EXPECT_EQ(within(map, sites, 1), within(map, sites, a + pitch));
        EXPECT_GT(*std::max_element(map.begin(), map.end()), 3 * map[map.size() / 2]);  // the rim
    }
}

TEST(Edge, HasTheWidthOfHertzsCylinderAndCanBeRotated) {
    const double F = 1, R = 2e-3, L = 10e-3, E = 100e3, b = std::sqrt(4 * F * R / (M_PI * L * E)), p0 = 2 * F / (M_PI * b * L);
    const auto sites = sheet(8e-3, 0.1e-3);
    const auto flat = force_map(*make_checked_contact("edge", {"edge_radius=2mm", "x=0", "y=0"}, sites), sites, F);
    EXPECT_NEAR(flat[flat.size() / 2] / 1e-8, p0, 0.02 * p0);
    for (const double angle : {0.0, 30.0, 90.0}) {
        const auto text = "angle=" + std::to_string(angle);
        const auto map = force_map(*make_checked_contact("edge", {"edge_radius=2mm", text.c_str(), "x=0", "y=0"}, sites), sites, F);
        double along = 0, across = 0;
        for (std::size_t s = 0; s < map.size(); ++s) {
            const double c = std::cos(angle * M_PI / 180), n = std::sin(angle * M_PI / 180);
            const double u = sites.positions[s].x * c + sites.positions[s].y * n, v = sites.positions[s].y * c - sites.positions[s].x * n;
            along += map[s] * u * u, across += map[s] * v * v;
        }
        EXPECT_NEAR(along, L * L / 12, 0.01 * L * L / 12)
            << angle;  // second moments of a uniform line along the edge, and of Hertz's half ellipse across it
        EXPECT_NEAR(across, b * b / 4, 0.02 * b * b / 4) << angle;
    }
}

TEST(Grating, RepeatsAfterOnePeriodInTimeAndSpace) {
    const auto sites = sheet(8e-3, 0.25e-3);
    const auto contact = make_checked_contact("grating", {"radius=6mm", "period=3mm", "ridge=1.5mm", "speed=30mm/s", "x=0", "y=0"}, sites);
    const auto first = force_map(*contact, sites, 1, 200), after_half_period = force_map(*contact, sites, 1, 250),
               after_period = force_map(*contact, sites, 1, 300);
    const auto near = force_map(*contact, sites, 1, 210);  // the grating has moved by 0.3 mm
    double same = 0, opposite = 0;                         // correlations with the first map, of `near` and of the map after half a period
    for (std::size_t s = 0; s < first.size(); ++s) {
        EXPECT_NEAR(first[s], after_period[s], 1e-12);
        if (std::hypot(sites.positions[s].x, sites.positions[s].y) > 5e-3) continue;
        same += first[s] * near[s], opposite += first[s] * after_half_period[s];
    }
    EXPECT_LT(opposite, 0.3 * same);
    const std::size_t n = 65, row = 32 * n;  // along the centre line: a period is 12 sites
    for (std::size_t c = 20; c < 32; ++c) EXPECT_NEAR(first[row + c], first[row + c + 12], 1e-12);
}

TEST(Path, IsAStraightLineAtConstantSpeed) {
    const auto sites = sheet(20e-3, 1e-3);
    const auto contact = make_checked_contact("sphere", {"x=-10mm", "y=5mm", "x1=10mm", "y1=-3mm", "t_start=0.1s", "t_move=0.4s"}, sites);
    for (const auto& [sample, x, y] :
         {std::tuple(0, -10.0, 5.0), {100, -10.0, 5.0}, {200, -5.0, 3.0}, {300, 0.0, 1.0}, {500, 10.0, -3.0}, {900, 10.0, -3.0}}) {
        const auto at = centroid(force_map(*contact, sites, 1, sample), sites);
        EXPECT_NEAR(at.x, x * 1e-3, 5e-5) << sample;
        EXPECT_NEAR(at.y, y * 1e-3, 5e-5) << sample;
    }
    EXPECT_NE(contact->description().find("moved from (-10, 5) mm to (10, -3) mm in 400 ms"), std::string::npos) << contact->description();
    const auto with_speed = make_checked_contact("flat", {"x=-10mm", "y=0", "x1=10mm", "speed=40mm/s"}, sites);
    EXPECT_NEAR(centroid(force_map(*with_speed, sites, 1, 250), sites).x, 0, 5e-5);
}

RC_GTEST_PROP(Contacts, GiveTheSameForceForAnyBlocks, ()) {
    const auto sites = sheet(10e-3, 1e-3);
    const std::size_t samples = 60;
    std::vector<double> force(samples);
    for (std::size_t k = 0; k < samples; ++k) force[k] = k % 17 == 0 ? 0 : 0.1 * static_cast<double>(k % 7);
    const auto run = [&](auto&& block) {
        const auto contact = make_checked_contact("sphere", {"x=-8mm", "y=0", "x1=8mm", "t_move=50ms", "roughness=0.1"}, sites);
        std::vector<double> out(sites.size() * samples, 0.0);
        for (std::size_t k = 0; k < samples;) {
            const auto n = std::min(samples - k, static_cast<std::size_t>(block()));
            const auto pressed = *contact->press({force.data() + k, n}, static_cast<std::int64_t>(k));
            RC_ASSERT(std::is_sorted(pressed.touched.begin(), pressed.touched.end()));
            for (const auto s : pressed.touched)
                for (std::size_t i = 0; i < n; ++i) out[s * samples + k + i] = pressed.data[s * pressed.stride + i];
            k += n;
        }
        return out;
    };
    const auto undivided = run([] { return 60; }), in_blocks = run([] { return *rc::gen::inRange(1, 30); });
    RC_ASSERT(std::memcmp(undivided.data(), in_blocks.data(), undivided.size() * sizeof(double)) == 0);
}

TEST(ContactOptions, AreRefusedWithARemedy) {
    const auto sites = sheet(10e-3, 1e-3);
    const auto error_text = [&](std::string_view indenter, std::initializer_list<const char*> settings) {
        std::vector<ParameterOverride> overrides;
        for (const std::string text : settings) overrides.push_back(*parse_override("contact." + text));
        const auto made = make_contact(indenter, overrides, sites, *make_clock(1000));
        return made ? "accepted" : made.error().text();
    };
    EXPECT_EQ(error_text("spere", {}), "there is no indenter 'spere'; did you mean 'sphere'? (there are flat, sphere, edge, grating)");
    EXPECT_EQ(error_text("sphere", {"period=2mm"}),
              "contact.period: sphere has no such parameter (it has radius, E_star, roughness, grain, and for its path and shear x, y, x1, "
              "y1, t_start, t_move, speed, tilt, azimuth, friction)");
    EXPECT_EQ(error_text("sphere", {"x1=2mm"}),
              "contact: the speed of the movement to x1, y1 is missing; give contact.t_move or contact.speed");
    EXPECT_EQ(error_text("flat", {"t_move=2s"}), "contact: the end of the movement is missing; give contact.x1 or contact.y1");
    EXPECT_EQ(error_text("flat", {"x1=3mm", "t_move=2s", "speed=1m/s"}),
              "contact: t_move and speed are alternatives; give only one of them");
    EXPECT_EQ(error_text("grating", {"ridge=3mm"}), "contact: ridge = 0.003 m must not be wider than period = 0.002 m");
    EXPECT_EQ(error_text("flat", {"radius=5s"}), "contact.radius: '5s' is a time; expected a value in m, such as '2 m'");
    EXPECT_EQ(
        make_contact("flat", std::vector<ParameterOverride>{*parse_override("contact.radius=1m")}, sheet(1e-3, 1e-5), *make_clock(1000))
            .
            operator bool(),
        true);
    double force = 1;
    const auto wide = make_checked_contact("flat", {"radius=1m"}, sites);
    EXPECT_EQ(wide->press({&force, 1}, 0).error().text(),
              "contact: with 1 N it is 2 m by 2 m wide, which is more than a million cells of 1 mm of this skin");
    force = std::nan("");
    EXPECT_EQ(wide->press({&force, 1}, 7).error().text(), "the force of sample 7 is nan, not a finite number");
}

}  // namespace
}  // namespace corpuscle
