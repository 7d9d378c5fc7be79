// Pieces of work on several threads.

#include "signal/pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace corpuscle {
namespace {

TEST(Pool, EveryPieceIsDoneOnceWhateverTheThreads) {
    for (const unsigned threads : {1U, 2U, 7U}) {
        Pool pool(threads);
        EXPECT_EQ(pool.threads(), threads);
        for (const std::size_t count : {0, 1, 2, 1000}) {
            std::vector<int> done(count);
            std::atomic<bool> strange = false;
            pool.each(count, [&](std::size_t k, unsigned thread) {
                ++done[k];
                if (thread >= threads) strange = true;
            });
            EXPECT_EQ(std::count(done.begin(), done.end(), 1), static_cast<std::ptrdiff_t>(count)) << threads;
            EXPECT_FALSE(strange);
        }
    }
    EXPECT_GE(Pool().threads(), 1U);
}

TEST(Pool, AnExceptionComesToTheCallerAndThePoolGoesOn) {
    Pool pool(3);
    EXPECT_THROW(pool.each(100,
                           [](std::size_t k, unsigned) {
                               if (k == 40) throw std::runtime_error("40");
                           }),
                 std::runtime_error);
    std::atomic<int> done = 0;
    pool.each(100, [&](std::size_t, unsigned) { ++done; });
    EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace corpuscle
