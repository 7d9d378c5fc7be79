// The outline of a skin is smooth, and encloses the area of its sites.

#include "skin/plan/skin_outline.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "skin/plan/skin_plan.hpp"

namespace corpuscle {
namespace {

/// Area (m2) of a polygon, positive if it is counter-clockwise.
double signed_area(const Polygon& points) {
    double twice = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto &a = points[k], &b = points[(k + 1) % points.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2;
}

double signed_area(const std::vector<Polygon>& polygons) {
    double sum = 0;
    for (const auto& polygon : polygons) sum += signed_area(polygon);
    return sum;
}

/// The largest angle (rad) between consecutive edges of a polygon.
double sharpest_turn(const Polygon& points) {
    double most = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto &a = points[k], &b = points[(k + 1) % points.size()], &c = points[(k + 2) % points.size()];
        const double turn = std::atan2(c.y - b.y, c.x - b.x) - std::atan2(b.y - a.y, b.x - a.x);
        most = std::max(most, std::abs(std::remainder(turn, 2 * std::numbers::pi)));
    }
    return most;
}

SkinShape outline_disc(double x, double y, double diameter) { return {SkinShape::Kind::ellipse, {{x, y, 0}}, diameter, diameter, 0}; }

TEST(SkinOutlineTest, AnOutlineOfADiscIsACircle) {
    const std::vector<SkinRegion> regions{{"disc", {outline_disc(0, 5e-3, 40e-3)}}};
    const auto outline = skin_outline(*fill_regions(regions, 2e-3));
    ASSERT_EQ(outline.skin.size(), 1U);
    ASSERT_EQ(outline.regions.size(), 1U);
    for (const auto& p : outline.skin[0]) EXPECT_NEAR(std::hypot(p.x, p.y - 5e-3), 20e-3, 0.3e-3);
    EXPECT_NEAR(signed_area(outline.skin), std::numbers::pi * 20e-3 * 20e-3, 0.02 * std::numbers::pi * 20e-3 * 20e-3);
    EXPECT_LT(sharpest_turn(outline.skin[0]), 0.5);
}

TEST(SkinOutlineTest, AHoleOfASkinIsAPolygonOfItsOwnInTheOtherDirection) {
    const auto strip = [](Position a, Position b) { return SkinShape{SkinShape::Kind::strip, {a, b}, 8e-3, 8e-3, 0}; };
    const std::vector<SkinRegion> regions{{"frame",
                                           {strip({-24e-3, -20e-3, 0}, {24e-3, -20e-3, 0}), strip({-24e-3, 20e-3, 0}, {24e-3, 20e-3, 0}),
                                            strip({-20e-3, -24e-3, 0}, {-20e-3, 24e-3, 0}), strip({20e-3, -24e-3, 0}, {20e-3, 24e-3, 0})}}};
    const auto outline = skin_outline(*fill_regions(regions, 2e-3)).skin;
    ASSERT_EQ(outline.size(), 2U);
    const double outer = std::max(signed_area(outline[0]), signed_area(outline[1])),
                 hole = std::min(signed_area(outline[0]), signed_area(outline[1]));
    EXPECT_NEAR(outer, 48e-3 * 48e-3, 0.02 * 48e-3 * 48e-3);
    EXPECT_NEAR(hole, -32e-3 * 32e-3, 0.03 * 32e-3 * 32e-3);
}

TEST(SkinOutlineTest, APointInTwoRegionsBelongsToTheFirst) {
    const std::vector<SkinRegion> regions{{"tip", {outline_disc(0, 0, 20e-3)}}, {"rest", {outline_disc(10e-3, 0, 20e-3)}}};
    const auto outline = skin_outline(*fill_regions(regions, 1e-3));
    EXPECT_NEAR(signed_area(outline.regions[0]), std::numbers::pi * 1e-4, 0.03 * std::numbers::pi * 1e-4);
    EXPECT_NEAR(signed_area(outline.regions[0]) + signed_area(outline.regions[1]), signed_area(outline.skin),
                0.02 * signed_area(outline.skin));
}

TEST(SkinOutlineTest, TheOutlineOfTheHandHasOneCurveWithoutSteps) {
    const auto hand = load_skin_plan("hand");
    ASSERT_TRUE(hand) << hand.error().text();
    const auto& sites = hand->sites;
    const auto outline = skin_outline(sites);
    ASSERT_EQ(outline.skin.size(), 1U);
    ASSERT_EQ(outline.regions.size(), sites.regions.size());
    const double area = static_cast<double>(sites.size()) * sites.area;
    EXPECT_NEAR(signed_area(outline.skin), area, 0.01 * area);
    EXPECT_LT(sharpest_turn(outline.skin[0]), 0.6);  // the steps of the sites turn by 1.57
}

TEST(SkinOutlineTest, SeparateSensorsHaveNoOutline) {
    const auto outline = skin_outline(*grid_sites(4, 4, 2e-3));
    EXPECT_TRUE(outline.skin.empty());
    EXPECT_TRUE(outline.regions.empty());
}

}  // namespace
}  // namespace corpuscle
