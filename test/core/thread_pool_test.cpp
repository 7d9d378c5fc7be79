// The thread pool runs tasks on several threads.

#include "core/thread_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace corpuscle {
namespace {

TEST(ThreadPool, EveryTaskRunsOnceForAnyNumberOfThreads) {
    for (const unsigned threads : {1U, 2U, 7U}) {
        ThreadPool pool(threads);
        EXPECT_EQ(pool.threads(), threads);
        for (const std::size_t count : {0, 1, 2, 1000}) {
            std::vector<int> done(count);
            std::atomic<bool> out_of_range = false;
            pool.for_each(count, [&](std::size_t k, unsigned thread) {
                ++done[k];
                if (thread >= threads) out_of_range = true;
            });
            EXPECT_EQ(std::count(done.begin(), done.end(), 1), static_cast<std::ptrdiff_t>(count)) << threads;
            EXPECT_FALSE(out_of_range);
        }
    }
    EXPECT_GE(ThreadPool().threads(), 1U);
}

TEST(ThreadPool, StartsItsThreadsForTheFirstTasksThatCanRunAtOnce) {
    const auto threads_of_process = [] {
        const std::filesystem::directory_iterator all("/proc/self/task");
        return std::distance(begin(all), end(all));
    };
    const auto before = threads_of_process();
    ThreadPool pool(3);
    std::atomic<int> done = 0;
    const auto count = [&](std::size_t, unsigned) { ++done; };
    for (int k = 0; k < 5; ++k) pool.for_each(1, count);
    EXPECT_EQ(threads_of_process(), before);
    pool.for_each(2, count);
    EXPECT_EQ(threads_of_process(), before + 2);
    EXPECT_EQ(done, 7);
}

TEST(ThreadPool, TheCallerIsCalledWhileItWaits) {
    ThreadPool pool(2);
    std::atomic<bool> was_called = false, has_begun = false;
    const auto wait = [&](std::size_t, unsigned thread) {
        has_begun = has_begun || thread == 1;
        while (thread == 1 ? !was_called : !has_begun) std::this_thread::yield();  // the caller ends first
    };
    pool.for_each(2, wait, [&] { was_called = true; });
    EXPECT_TRUE(was_called);
}

TEST(ThreadPool, AnExceptionReachesTheCallerAndThePoolContinues) {
    ThreadPool pool(3);
    EXPECT_THROW(pool.for_each(100,
                               [](std::size_t k, unsigned) {
                                   if (k == 40) throw std::runtime_error("40");
                               }),
                 std::runtime_error);
    std::atomic<int> done = 0;
    pool.for_each(100, [&](std::size_t, unsigned) { ++done; });
    EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace corpuscle
