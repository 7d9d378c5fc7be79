#include "measure/train_distance.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "support/processor_time.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using Train = std::vector<double>;
using test::value_or_throw;

double distance(const Train& a, const Train& b, double q) { return value_or_throw(victor_purpura(a, b, q)); }

/// The dynamic program of Victor and Purpura, with every cell computed.
double full_table(const Train& a, const Train& b, double q) {
    std::vector<std::vector<double>> g(a.size() + 1, Train(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                g[i][j] = static_cast<double>(i + j);
                continue;
            }
            g[i][j] = std::min({g[i - 1][j] + 1, g[i][j - 1] + 1, g[i - 1][j - 1] + q * std::abs(a[i - 1] - b[j - 1])});
        }
    return g[a.size()][b.size()];
}

/// The square of the van Rossum distance, as a sum over all pairs of spikes.
double all_pairs(const Train& a, const Train& b, double tau) {
    const auto sum = [tau](const Train& x, const Train& y) {
        double all = 0;
        for (const double s : x)
            for (const double t : y) all += std::exp(-std::abs(s - t) / tau);
        return all;
    };
    return sum(a, a) + sum(b, b) - 2 * sum(a, b);
}

/// A train on a grid of milliseconds, so that spikes coincide often.
Train random_train() {
    auto at = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 300));
    std::sort(at.begin(), at.end());
    Train spikes;
    for (const int t : at) spikes.push_back(1e-3 * t);
    return spikes;
}

double random_cost() { return *rc::gen::element(0.0, 0.5, 10.0, 37.0, 200.0, 2000.0, 1e9); }

TEST(VictorPurpura, EqualsTheFullDynamicProgramAtAnyCost) {
    EXPECT_TRUE(rc::check("equals the full table", [] {
        const auto a = random_train(), b = random_train();
        const double q = random_cost();
        RC_ASSERT(std::abs(distance(a, b, q) - full_table(a, b, q)) < 1e-9 * static_cast<double>(a.size() + b.size() + 1));
    }));
}

TEST(VictorPurpura, IsADistance) {
    EXPECT_TRUE(rc::check("symmetry, identity, triangle", [] {
        const auto a = random_train(), b = random_train(), c = random_train();
        const double q = random_cost();
        RC_ASSERT(distance(a, a, q) == 0);
        RC_ASSERT(std::abs(distance(a, b, q) - distance(b, a, q)) < 1e-9);
        RC_ASSERT(distance(a, c, q) <= distance(a, b, q) + distance(b, c, q) + 1e-9);
        RC_ASSERT(a == b || q == 0 || distance(a, b, q) > 0);
    }));
}

TEST(VictorPurpura, IsTheDifferenceOfCountsAtZeroCostAndTheTotalCountAtInfiniteCost) {
    const Train a = {0.1, 0.2, 0.3}, b = {0.15, 0.31, 0.4, 0.5, 0.6};
    EXPECT_EQ(distance(a, b, 0), 2) << "q -> 0: the difference of the counts";
    EXPECT_EQ(distance(a, b, 1e12), 8) << "q -> inf: the number of all spikes";
    EXPECT_EQ(distance(a, {}, 7), 3);
    EXPECT_EQ(distance({}, {}, 7), 0);
    EXPECT_NEAR(distance({0.1}, {0.101}, 100), 0.1, 1e-12);
    EXPECT_EQ(distance({0.1}, {0.2}, 100), 2) << "moving costs more than removing and adding";
}

TEST(VictorPurpura, MovesAreInOrderAndTheirCostsAddUpToTheDistance) {
    EXPECT_TRUE(rc::check("the moved pairs of an alignment", [] {
        const auto a = random_train(), b = random_train();
        const double q = random_cost();
        const auto aligned = value_or_throw(align_trains(a, b, q));
        double cost = static_cast<double>(a.size() + b.size() - 2 * aligned.moved.size());
        for (std::size_t k = 0; k < aligned.moved.size(); ++k) {
            const auto [i, j] = aligned.moved[k];
            RC_ASSERT(q * std::abs(a[i] - b[j]) < 2);
            if (k > 0) RC_ASSERT(aligned.moved[k - 1].a < i && aligned.moved[k - 1].b < j);
            cost += q * std::abs(a[i] - b[j]);
        }
        RC_ASSERT(std::abs(cost - aligned.distance) < 1e-9 * static_cast<double>(a.size() + b.size() + 1));
        RC_ASSERT(std::abs(aligned.distance - distance(a, b, q)) < 1e-12);
    }));
}

/// A Poisson train of 100 Hz.
Train poisson(std::size_t count, std::uint32_t index) {
    Train spikes;
    double t = 0;
    for (std::uint64_t k = 0; k < count; ++k) {
        const double x = normal(1, index, 0, 2 * k), y = normal(1, index, 0, 2 * k + 1);
        spikes.push_back(t += 5e-3 * (x * x + y * y));
    }
    return spikes;
}

TEST(VictorPurpura, AHundredThousandSpikesTakeUnderASecondAndTooManyPairsAreRefused) {
    const auto a = poisson(100'000, 1), b = poisson(100'000, 2);
    std::size_t moved = 0;
    EXPECT_LT(test::processor_time([&] { moved = value_or_throw(align_trains(a, b, 100)).moved.size(); }), 1)
        << "sanitizers take 10 times longer";
    EXPECT_GT(moved, 50'000U);
    const auto refused = victor_purpura(a, b, 1e-4);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message.substr(0, 117),
              "at a cost of 0.0001 per second, trains of 100000 and 100000 spikes have 10000000000 pairs that could be moved to each");
}

// 25 million pairs; the decisions for only 4 million of them are stored at once.
TEST(VictorPurpura, AlignsTrainsWithMorePairsThanAreStoredAtOnce) {
    std::vector<double> a, b;
    for (int k = 0; k < 5000; ++k) a.push_back(1e-6 * k), b.push_back(1e-6 * (k + (k * 7919) % 13));
    std::sort(b.begin(), b.end());
    b.resize(4990);
    const double q = 1;
    const auto found = align_trains(a, b, q);
    ASSERT_TRUE(found) << found.error().text();
    ASSERT_EQ(found->moved.size(), b.size());
    double cost = static_cast<double>(a.size() - b.size());
    for (std::size_t k = 0; k < found->moved.size(); ++k) {
        const auto& m = found->moved[k];
        if (k > 0) {
            EXPECT_LT(found->moved[k - 1].a, m.a);
            EXPECT_LT(found->moved[k - 1].b, m.b);
        }
        cost += q * std::abs(a[m.a] - b[m.b]);
    }
    EXPECT_NEAR(found->distance, cost, 1e-9);
    EXPECT_NEAR(found->distance, *victor_purpura(a, b, q), 1e-9);
}

TEST(VanRossum, EqualsTheSumOverAllPairs) {
    EXPECT_TRUE(rc::check("equals the double sum", [] {
        const auto a = random_train(), b = random_train();
        const double tau = *rc::gen::element(1e-4, 1e-3, 1e-2, 1.0, 100.0);
        const auto n = static_cast<double>(a.size() + b.size() + 1);
        RC_ASSERT(std::abs(van_rossum_squared(a, b, tau) - all_pairs(a, b, tau)) < 1e-11 * n * n);
    }));
}

TEST(VanRossum, IsADistance) {
    EXPECT_TRUE(rc::check("symmetry, identity, triangle", [] {
        const auto a = random_train(), b = random_train(), c = random_train();
        const double tau = *rc::gen::element(1e-3, 1e-2, 1.0);
        const auto d = [tau](const Train& x, const Train& y) { return std::sqrt(van_rossum_squared(x, y, tau)); };
        RC_ASSERT(d(a, a) == 0);
        RC_ASSERT(std::abs(d(a, b) * d(a, b) - d(b, a) * d(b, a)) < 1e-9);
        RC_ASSERT(d(a, c) <= d(a, b) + d(b, c) + 1e-6);
    }));
}

TEST(VanRossum, OneExtraSpikeCountsOneAndAFarPairTwo) {
    EXPECT_EQ(van_rossum_squared({}, Train{3}, 1e-2), 1);
    EXPECT_NEAR(van_rossum_squared(Train{1}, Train{1, 3}, 1e-2), 1, 1e-12);
    EXPECT_NEAR(van_rossum_squared(Train{1}, Train{2}, 1e-2), 2, 1e-12);
    EXPECT_NEAR(van_rossum_squared(Train{1}, Train{1.01}, 1e-2), 2 * (1 - std::exp(-1)), 1e-12);
    EXPECT_NEAR(van_rossum_squared(Train{1, 2}, Train{1, 2, 3, 4, 5}, 1e9), 9, 1e-6) << "tau -> inf: the difference of the counts";
}

}  // namespace
}  // namespace corpuscle
