// Clocks, spikes, saved states, random numbers: the basic types of the library.

#include "support/property.hpp"

#include <cmath>

#include "core/random.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Clock, IsAnExactFractionOfASecond) {
    const auto fraction = [](double rate) {
        const auto c = test::value_or_throw(make_clock(rate));
        return std::pair(c.rate_numerator, c.rate_denominator);
    };
    EXPECT_EQ(fraction(1000), std::pair(std::int64_t{1000}, std::int64_t{1}));
    EXPECT_EQ(fraction(242.6), std::pair(std::int64_t{1213}, std::int64_t{5}));
    EXPECT_EQ(fraction(0.1), std::pair(std::int64_t{1}, std::int64_t{10}));
    for (const double rate : {M_PI, 1 / 3.0, 1e9 + 0.5, 44100 / 1.001})
        EXPECT_NEAR(test::value_or_throw(make_clock(rate)).rate(), rate, 1e-12 * rate);
}

TEST(Clock, TimesOfALongRunHaveNoAccumulatedError) {
    const auto c = test::value_or_throw(make_clock(10e3, 2.5));
    EXPECT_EQ(c.time(0), 2.5);
    EXPECT_EQ(c.time(36'000'000'000), 2.5 + 3.6e6);  // a thousand hours
    EXPECT_EQ(c.time(11, 0.5), 2.5 + 10.5 / 10e3);
}

TEST(Clock, RefusesInvalidRates) {
    for (const double rate : {0.0, -1.0, 1e13, std::nan("")}) EXPECT_FALSE(make_clock(rate)) << rate;
}

TEST(Spike, IsOrderedByTimeThenAfferent) {
    EXPECT_LT((Spike{3, 0.9, 7}), (Spike{4, 0.1, 0}));
    EXPECT_LT((Spike{4, 0.1, 7}), (Spike{4, 0.2, 0}));
    EXPECT_LT((Spike{4, 0.1, 0}), (Spike{4, 0.1, 1}));
}

RC_GTEST_PROP(State, IsUnchangedByPackingAndUnpacking, ()) {
    const State s{*rc::gen::container<std::string>(rc::gen::inRange('a', 'z')), *rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53),
                  *rc::gen::arbitrary<std::vector<double>>()};
    const auto back = unpack(pack(s));
    RC_ASSERT(static_cast<bool>(back));
    RC_ASSERT(back->format == s.format && back->step == s.step && back->values == s.values);
}

TEST(State, TruncatedOrForeignBytesAreRefused) {
    const auto bytes = pack({"sa1b+lif-b/1", 5, {1, 2, 3}});
    for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(unpack(std::span(bytes).first(n))) << n;
    auto longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(unpack(longer));
    EXPECT_FALSE(unpack(pack({"sa1b+lif-b/1", -1, {}}))) << "found by fuzzing: a step that the next block would overflow";
    EXPECT_FALSE(unpack(pack({"sa1b+lif-b/1", std::numeric_limits<std::int64_t>::max(), {}})));
    EXPECT_FALSE(unpack(pack({"sa1b+lif-b/1", 0, {std::nan("")}})));
    auto foreign = bytes;
    foreign[0] = std::byte{'x'};
    EXPECT_FALSE(unpack(foreign));
}

TEST(State, AFlippedBitIsRefused) {
    const auto bytes = pack({"sa1b+lif-b/1", 5, {1, 2, 3}});
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        auto damaged = bytes;
        damaged[bit / 8] ^= std::byte{1} << (bit % 8);
        EXPECT_FALSE(unpack(damaged)) << bit;
    }
}

TEST(State, ThePreviousVersionIsReadAndALaterOneRefused) {
    auto bytes = pack({"sa1b+lif-b/1", 5, {1, 2, 3}});
    bytes[6] = std::byte{'3'};
    const auto later = unpack(bytes);
    ASSERT_FALSE(later);
    EXPECT_NE(later.error().message.find("a version later than 2"), std::string::npos) << later.error().message;
    bytes[6] = std::byte{'1'};
    bytes.resize(bytes.size() - 8);  // version 1 has no checksum
    const auto before = unpack(bytes);
    ASSERT_TRUE(before);
    EXPECT_EQ(before->values, (std::vector<double>{1, 2, 3}));
}

TEST(RandomNumbers, PhiloxGivesThePublishedNumbers) {  // test vectors of Random123, kat_vectors
    EXPECT_EQ(philox({0, 0, 0, 0}, 0), (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox({~0U, ~0U, ~0U, ~0U}, ~0ULL), (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0a4093822),
              (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomNumbers, NormalDeviatesHaveTheMomentsOfANormalDistribution) {
    constexpr int n = 200000;
    double sum = 0, square = 0, fourth = 0;
    for (std::uint64_t k = 0; k < n; ++k) {
        const double x = normal(7, 1, 2, k);
        sum += x, square += x * x, fourth += x * x * x * x;
    }
    EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
    EXPECT_NEAR(square / n, 1, 5 * std::sqrt(2.0 / n));
    EXPECT_NEAR(fourth / n, 3, 5 * std::sqrt(96.0 / n));
    EXPECT_NE(normal(7, 1, 2, 0), normal(8, 1, 2, 0));
    EXPECT_NE(normal(7, 1, 2, 0), normal(7, 2, 2, 0));
}

}  // namespace
}  // namespace corpuscle
