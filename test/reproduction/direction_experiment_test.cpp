// The fingertip under forces in five directions (thesis fig. 4 A): most SA-I, FA-I and SA-II are tuned, to all directions.

#include "reproduction/skin/direction_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/support.hpp"

namespace corpuscle::directions {
namespace {

TEST(DirectionExperiment, MostAfferentsOfThreeClassesAreTunedAndTogetherPreferAllDirections) {
    const auto all = test::value_or_throw(measure_tuning());
    for (const std::string type : {"sa1", "fa1", "sa2"}) {
        double responding = 0, directional = 0, agreeing = 0;
        std::vector<double> angles;  // degrees, of the directions that spikes prefer
        for (const auto& u : all) {
            if (u.afferent.substr(0, 3) != type || !u.responds()) continue;
            ++responding;
            if (!u.is_tuned()) continue;
            ++directional, angles.push_back(std::atan2(u.y(), u.x()) * 180 / std::numbers::pi);
            agreeing += u.x() * std::cos(u.direction) + u.y() * std::sin(u.direction) > 0;
        }
        EXPECT_GE(responding, 10) << type;
        EXPECT_GT(directional, responding / 2) << type;
        EXPECT_GE(agreeing, directional * 0.95) << type << ": spikes prefer the direction of the afferent";
        std::sort(angles.begin(), angles.end());
        double gap = angles.front() + 360 - angles.back();
        for (std::size_t k = 1; k < angles.size(); ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
        EXPECT_LT(gap, type == "sa2" ? 120 : 60) << type;  // few SA-II are under the punch
    }
}

TEST(DirectionExperiment, AfferentsWithoutDirectionGainAreNotTuned) {
    for (const auto& u : test::value_or_throw(measure_tuning())) {
        if (u.afferent.substr(0, 3) != "fa2") continue;
        for (const double spikes : u.spikes) EXPECT_EQ(spikes, u.normal);
    }
}

}  // namespace
}  // namespace corpuscle::directions
