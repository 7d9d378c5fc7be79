#include "reproduction/claims/study_netlist.hpp"

#include <algorithm>
#include <cmath>

#include "reproduction/claims/sample_statistics.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(StudyNetlist, RunsWithItsOwnDirectivesOrOthers) {
    const auto own = test::value_or_throw(run_study_netlist({"inverter"}));
    EXPECT_NEAR(own.number("v_q"), 355e-3, 1e-3);
    EXPECT_FALSE(own.curve("dc", "v(out)").empty());
    const auto other = test::value_or_throw(run_study_netlist({"inverter", {}, ".dc vin 0 0.2\n+ 0.1\n.meas dc low find v(out) at=0.1"}));
    EXPECT_TRUE(std::isnan(other.number("v_q")));
    EXPECT_EQ(other.curve("dc", "v(out)").x, (std::vector<double>{0, 0.1, 0.2}));
    EXPECT_EQ(other.number("low"), other.curve("dc", "v(out)").y[1]);
    EXPECT_TRUE(other.curve("ac", "v(out)").empty());
    EXPECT_TRUE(other.curve("dc", "v(nowhere)").empty());
}

TEST(StudyNetlist, AppliesSettings) {
    const auto half = test::value_or_throw(run_study_netlist({"bias", {"i_bias=100n", "corner=ss"}, ".op"}));
    EXPECT_NEAR(half.operating_point("i(vis)"), 100e-9, 2e-9);
    EXPECT_TRUE(std::isnan(half.operating_point("v(nowhere)")));
    const auto refused = run_study_netlist({"bias", {"i_bia=100n"}, ".op"});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("did you mean 'i_bias'"), std::string::npos) << refused.error().message;
    EXPECT_FALSE(run_study_netlist({"nowhere"}));
    EXPECT_FALSE(run_study_netlist({"bias", {"i_bias"}, ".op"}));
}

TEST(StudyNetlist, IncludesSubcircuitsOfOtherNetlists) {
    const auto found = test::value_or_throw(
        run_study_netlist({"A divider\n.lib '../process/tsmc180.lib' tt\nv1 a 0 2\nr1 a b 1k\nr2 b 0 3k\n.op\n.end\n"}));
    EXPECT_NEAR(found.operating_point("v(b)"), 1.5, 1e-9);
    const auto bias = test::value_or_throw(elaborate_study_netlist({"bias"}));
    EXPECT_EQ(std::count_if(bias->elements.begin(), bias->elements.end(), [](const auto& e) { return e.letter == 'm'; }), 11);
}

TEST(StudyNetlist, GivesEveryVariant) {
    const auto all = test::value_or_throw(run_study_variants({"divider", {}, ".step temp list 0 27 85\n.op"}));
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[2].label, "temp=85");
    const auto chips = test::value_or_throw(run_study_variants({"quiescent", {}, ".op\n.mc 50 process=0"}));
    const auto spread = sample_statistics(chips, "v(qa)");
    EXPECT_EQ(spread.values.size(), 50u);
    EXPECT_NEAR(spread.mean, 355e-3, 1e-3);
    EXPECT_GT(spread.standard_deviation, 0.2e-3);
    EXPECT_LT(spread.standard_deviation, 1e-3);
}

TEST(StudyNetlist, DeviationsAreThoseOfASample) {
    const auto s = sample_statistics({1, 2, 3, 4});
    EXPECT_EQ(s.mean, 2.5);
    EXPECT_NEAR(s.standard_deviation, std::sqrt(5.0 / 3), 1e-15);
    EXPECT_NEAR(s.cv_percent(), 100 * std::sqrt(5.0 / 3) / 2.5, 1e-12);
}

}  // namespace
}  // namespace corpuscle
