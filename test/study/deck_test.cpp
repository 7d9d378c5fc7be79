#include "study/deck.hpp"

#include <algorithm>
#include <cmath>

#include "study/spread.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Deck, RunsANetlistUnderItsOwnOrdersOrOthers) {
    const auto own = test::sure(found_in({"inverter"}));
    EXPECT_NEAR(own.number("v_q"), 355e-3, 1e-3);
    EXPECT_FALSE(own.line("dc", "v(out)").empty());
    const auto other = test::sure(found_in({"inverter", {}, ".dc vin 0 0.2\n+ 0.1\n.meas dc low find v(out) at=0.1"}));
    EXPECT_TRUE(std::isnan(other.number("v_q")));
    EXPECT_EQ(other.line("dc", "v(out)").x, (std::vector<double>{0, 0.1, 0.2}));
    EXPECT_EQ(other.number("low"), other.line("dc", "v(out)").y[1]);
    EXPECT_TRUE(other.line("ac", "v(out)").empty());
    EXPECT_TRUE(other.line("dc", "v(nowhere)").empty());
}

TEST(Deck, SetsWhatIsSet) {
    const auto half = test::sure(found_in({"bias", {"i_bias=100n", "corner=ss"}, ".op"}));
    EXPECT_NEAR(half.at_rest("i(vis)"), 100e-9, 2e-9);
    EXPECT_TRUE(std::isnan(half.at_rest("v(nowhere)")));
    const auto refused = found_in({"bias", {"i_bia=100n"}, ".op"});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("did you mean 'i_bias'"), std::string::npos) << refused.error().message;
    EXPECT_FALSE(found_in({"nowhere"}));
    EXPECT_FALSE(found_in({"bias", {"i_bias"}, ".op"}));
}

TEST(Deck, TakesATextOfItsOwnWithThePartsOfOthers) {
    const auto found = test::sure(found_in({"A divider\n.lib '../process/tsmc180.lib' tt\nv1 a 0 2\nr1 a b 1k\nr2 b 0 3k\n.op\n.end\n"}));
    EXPECT_NEAR(found.at_rest("v(b)"), 1.5, 1e-9);
    const auto bias = test::sure(circuit_of({"bias"}));
    EXPECT_EQ(std::count_if(bias->elements.begin(), bias->elements.end(), [](const auto& e) { return e.letter == 'm'; }), 11);
}

TEST(Deck, GivesEveryVariant) {
    const auto all = test::sure(all_found_in({"divider", {}, ".step temp list 0 27 85\n.op"}));
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[2].label, "temp=85");
    const auto chips = test::sure(all_found_in({"quiescent", {}, ".op\n.mc 50 process=0"}));
    const auto spread = spread_of(chips, "v(qa)");
    EXPECT_EQ(spread.values.size(), 50u);
    EXPECT_NEAR(spread.mean, 355e-3, 1e-3);
    EXPECT_GT(spread.deviation, 0.2e-3);
    EXPECT_LT(spread.deviation, 1e-3);
}

TEST(Deck, SpreadsAsASampleDoes) {
    const auto s = spread_of({1, 2, 3, 4});
    EXPECT_EQ(s.mean, 2.5);
    EXPECT_NEAR(s.deviation, std::sqrt(5.0 / 3), 1e-15);
    EXPECT_NEAR(s.percent(), 100 * std::sqrt(5.0 / 3) / 2.5, 1e-12);
}

}  // namespace
}  // namespace corpuscle
