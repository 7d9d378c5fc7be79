#include "run/compare/train_comparison.hpp"

#include <cmath>

#include "support/processor_time.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;
using Names = std::vector<std::pair<std::string, std::string>>;

std::vector<NamedTrain> trains(const Names& names) {
    std::vector<NamedTrain> all;
    for (const auto& [afferent, channel] : names) all.push_back({afferent, channel, {0.1, 0.2}});
    return all;
}

/// The names of the trains that are paired, or the error.
std::string pairs(const Names& a, const Names& b, const CompareOptions& options = {}) {
    const auto in_a = trains(a), in_b = trains(b);
    const auto found = pair_trains(in_a, in_b, options);
    if (!found) return found.error().message;
    std::string text;
    for (const auto& p : *found) text += (text.empty() ? "" : " ") + (p.a ? p.a->name() : "") + "=" + (p.b ? p.b->name() : "");
    return text;
}

TEST(PairTrains, PairsEqualNamesAndTheOthersWithEmptyTrains) {
    EXPECT_EQ(pairs({{"fa1", "x"}, {"sa1", "x"}}, {{"sa1", "x"}, {"sa2", "x"}}), "fa1,x= sa1,x=sa1,x =sa2,x");
    EXPECT_EQ(pairs({{"sa1", "x"}}, {}), "sa1,x=") << "B was silent";
    EXPECT_EQ(pairs({{"7", ""}}, {{"sa1", "x"}}), "7=sa1,x") << "the only train of each file";
}

TEST(PairTrains, AFileWithoutChannelsMatchesOneWithChannelsIfThePairIsUnique) {
    EXPECT_EQ(pairs({{"sa1#1", ""}, {"sa1#2", ""}}, {{"sa1#2", "palm"}, {"sa1#1", "thumb"}}), "sa1#1=sa1#1,thumb sa1#2=sa1#2,palm");
    EXPECT_EQ(pairs({{"fa1#1", "palm"}, {"sa1#1", "palm"}}, {{"sa1#1", ""}}), "fa1#1,palm= sa1#1,palm=sa1#1");
    EXPECT_EQ(pairs({{"fa1#1", ""}, {"sa1#1", ""}}, {{"fa1", "press"}, {"sa1", "press"}}), "fa1#1=fa1,press sa1#1=sa1,press")
        << "address events of one channel";
    EXPECT_EQ(pairs({{"fa1", "press"}, {"sa1", "press"}}, {{"fa1#1", ""}, {"sa1#1", ""}}), "fa1,press=fa1#1 sa1,press=sa1#1");
    EXPECT_EQ(pairs({{"sa1", ""}, {"fa1", "x"}}, {{"fa1", "x"}, {"sa1", "x"}, {"sa1", "y"}}), "sa1= fa1,x=fa1,x =sa1,x =sa1,y");
    EXPECT_EQ(pairs({{"sa1#1", ""}, {"fa1", "x"}}, {{"fa1", "x"}, {"sa1", "x"}, {"sa1", "y"}}), "sa1#1= fa1,x=fa1,x =sa1,x =sa1,y");
}

TEST(PairTrains, APairOfNamesAppliesToEveryChannelOrEveryAfferent) {
    const Names two = {{"sa1", "x"}, {"sa1", "y"}}, kim = {{"sa1-kim", "x"}, {"sa1-kim", "y"}};
    EXPECT_EQ(pairs(two, kim, {.pairs = {"sa1=sa1-kim"}}), "sa1,x=sa1-kim,x sa1,y=sa1-kim,y");
    EXPECT_EQ(pairs({{"fa1", "fz"}, {"sa1", "fz"}}, {{"fa1", "fz_abs"}, {"sa1", "fz_abs"}}, {.pairs = {"fz=fz_abs"}}),
              "fa1,fz=fa1,fz_abs sa1,fz=sa1,fz_abs");
    EXPECT_EQ(pairs(two, kim, {.pairs = {"sa1,x=sa1-kim,y"}}), "sa1,x=sa1-kim,y");
    EXPECT_EQ(pairs({{"11", ""}, {"12", ""}}, {{"sa1", "x"}, {"fa1", "x"}}, {.pairs = {"11=sa1,x", "12=fa1"}}), "11=sa1,x 12=fa1,x");
    EXPECT_EQ(pairs(two, two, {.pairs = {"x=y"}}), "sa1,x=sa1,y") << "two trains of one file";
    EXPECT_EQ(pairs({{"1", ""}, {"2", ""}}, two, {.by_order = true}), "1=sa1,x 2=sa1,y");
}

TEST(PairTrains, ErrorsNameTheOptionsThatWork) {
    const Names fz = {{"fa1", "fz"}, {"sa1", "fz"}}, abs = {{"fa1", "fz_abs"}, {"sa1", "fz_abs"}};
    EXPECT_EQ(pairs(fz, abs),
              "no train has the same name in both files: fa1,fz; sa1,fz | fa1,fz_abs; sa1,fz_abs; --pair fz=fz_abs would compare these, "
              "--by-order compares all of them in this order");
    EXPECT_EQ(pairs(fz, {{"sa1-kim", "fz"}}),
              "no train has the same name in both files: fa1,fz; sa1,fz | sa1-kim,fz; --pair fa1=sa1-kim would compare these");
    EXPECT_EQ(pairs(fz, abs, {.pairs = {"fz"}}), "--pair fz: write A-NAME=B-NAME, such as sa1=sa1-kim");
    EXPECT_EQ(pairs(fz, abs, {.pairs = {"fz=fx"}}), "--pair fz=fx: the second file has no train 'fx'; it has fa1,fz_abs; sa1,fz_abs");
    EXPECT_EQ(
        pairs(fz, {{"7", "a"}, {"7", "b"}}, {.pairs = {"fz=7"}}),
        "--pair fz=7: matches 2 trains of the first file and 2 of the second, and no two of their names differ only in this part; name "
        "one train of each file, "
        "such as --pair 'fa1,fz=7,a'");
    EXPECT_EQ(pairs(fz, {{"1", ""}}, {.by_order = true}),
              "--by-order: the first file has 2 trains, the second 1; --pair A-NAME=B-NAME selects trains to compare");
    EXPECT_EQ(pairs(fz, abs, {.pairs = {"fz=fz_abs"}, .by_order = true}), "--by-order and --pair are alternatives: give one");
}

// Names are looked up in an index. A search through all trains would take minutes.
TEST(PairTrains, OfAHundredThousandTrainsTakesLessThanFiveSeconds) {
    std::vector<NamedTrain> a, b;
    for (int k = 0; k < 100'000; ++k)
        a.push_back({"sa1#" + std::to_string(k), "press", {}}), b.push_back({"sa1#" + std::to_string(100'000 - k), "press", {}});
    std::size_t pairs = 0;
    EXPECT_LT(test::processor_time([&] { pairs = value_or_throw(pair_trains(a, b, {})).size(); }), 5);
    EXPECT_EQ(pairs, 100'001U) << "one train of each file has no partner";
}

TEST(Compare, CountsMatchedMissingAndExtraSpikes) {
    const NamedTrain a{"a", "", {0.1, 0.2, 0.3, 0.4}}, b{"b", "", {0.101, 0.198, 0.35, 0.4, 0.6}};
    const auto d = value_or_throw(compare_trains({&a, &b}, {}));
    EXPECT_EQ(d.matched, 3U);
    EXPECT_EQ(d.missing(), 1U);
    EXPECT_EQ(d.extra(), 2U);
    EXPECT_NEAR(d.max_shift, 2e-3, 1e-12);
    EXPECT_NEAR(d.rms(), std::sqrt((1e-6 + 4e-6) / 3), 1e-12);
    EXPECT_NEAR(d.victor_purpura, 3 + 0.3, 1e-9);
    EXPECT_NEAR(d.victor_purpura_per_spike(), 3.3 / 9, 1e-9);
    const auto silence = value_or_throw(compare_trains({&a, nullptr}, {}));
    EXPECT_EQ(silence.missing(), 4U);
    EXPECT_EQ(silence.victor_purpura_per_spike(), 1);
    EXPECT_TRUE(std::isnan(silence.rms()));
    auto total = d;
    total.add(silence);
    EXPECT_EQ(total.missing(), 5U);
    EXPECT_NEAR(total.van_rossum() * total.van_rossum(), d.van_rossum_squared + silence.van_rossum_squared, 1e-12);
}

}  // namespace
}  // namespace corpuscle
