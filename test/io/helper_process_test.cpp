// A helper that dies, hangs up or is stopped costs an error; it never costs us.

#include "io/helper_process.hpp"

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "io/remote_samples.hpp"
#include "support/child_process.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

std::string death_of(const std::function<void(int)>& work) {
    auto helper = test::sure(HelperProcess::start(work));
    const auto answer = helper.answer("x.h5", "the library");
    return answer ? "answered" : answer.error().text();
}

std::size_t descriptors() {
    std::size_t count = 0;
    DIR* all = ::opendir("/proc/self/fd");
    while (::readdir(all)) ++count;
    ::closedir(all);
    return count;
}

TEST(HelperProcess, WhatKillsItIsSaid) {
    EXPECT_EQ(death_of([](int) { std::raise(SIGSEGV); }), "x.h5: the library could not read this file (signal 11): damaged?");
    EXPECT_EQ(death_of([](int) { std::raise(SIGABRT); }), "x.h5: the library could not read this file (signal 6): damaged?");
    EXPECT_EQ(death_of([](int) { ::_exit(3); }), "x.h5: the library could not read this file (status 3): damaged?");
    EXPECT_EQ(death_of([](int) { std::raise(SIGALRM); }), "x.h5: the library did not read this file within 60 s: damaged?");
    EXPECT_EQ(death_of([](int) { std::raise(SIGINT); }), "x.h5: interrupted");
}

TEST(HelperProcess, TheTimeForAnAnswerRunsWhileAQuestionIsOpen) {
    auto helper = test::sure(HelperProcess::start([](int socket) {
        for (Message m; next_question(socket, m);) {
            Message seconds;
            const unsigned left = ::alarm(HelperProcess::seconds_to_answer);
            seconds.put(left);
            give_answer(socket, seconds);
        }
    }));
    for (int k = 0; k < 2; ++k) {
        helper.ask({});
        auto answer = test::sure(helper.answer("x", "it"));
        std::uint64_t seconds = 0;
        EXPECT_TRUE(answer.get(seconds));
        EXPECT_GE(seconds, HelperProcess::seconds_to_answer - 1U);
    }
}

TEST(HelperProcess, HoldsNothingOfOursAndLeavesNothingBehind) {
    const auto before = descriptors();
    {
        auto first = test::sure(HelperProcess::start([](int socket) {
            Message m;
            m.put(descriptors());
            m.send(socket);
            for (;;) ::pause();
        }));
        auto answer = test::sure(first.answer("x", "it"));
        std::uint64_t held = 0;
        EXPECT_TRUE(answer.get(held));
        EXPECT_EQ(held, 4 + 3U) << "four of its own, '.', '..', and the list's";
        auto second = std::move(first);
        EXPECT_TRUE(test::signal_child(second.id(), 0));
    }
    EXPECT_EQ(descriptors(), before);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
}

/// Dies on the second fetch.
class Mortal final : public Samples {
    SamplesFacts facts_{{{"fz", "N"}}, 10, 100.0, {}};
    int lives_ = 1;

public:
    const SamplesFacts& facts() const override { return facts_; }
    Result<void> fetch(std::int64_t, std::size_t, std::span<const std::size_t>, std::vector<std::vector<double>>&) override {
        if (lives_-- == 0) std::raise(SIGBUS);
        return {};
    }
};

TEST(HelperProcess, ADeathWhileRowsAreReadIsAnErrorThenAndEverAfter) {
    auto samples = test::sure(in_helper_process("x.h5", "it", []() -> SamplesResult { return std::unique_ptr<Samples>(new Mortal); }));
    EXPECT_EQ(samples->facts().columns.at(0).unit, "N");
    EXPECT_EQ(samples->facts().rate, 100);
    const std::vector<std::size_t> wanted = {0};
    std::vector<std::vector<double>> out(1, std::vector<double>(1));
    EXPECT_TRUE(samples->fetch(0, 1, wanted, out));
    EXPECT_EQ(samples->fetch(0, 1, wanted, out).error().text(), "x.h5: it could not read this file (signal 7): damaged?");
    EXPECT_FALSE(samples->fetch(0, 1, wanted, out));
}

#ifdef __has_feature
constexpr bool sanitized = __has_feature(address_sanitizer);
#elif defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

TEST(HelperProcess, MemoryWithoutEndIsRefused) {
    if (sanitized) GTEST_SKIP() << "AddressSanitizer ends a process that gets no memory";
    const auto samples = in_helper_process("x.h5", "it", []() -> SamplesResult {
        std::vector<std::unique_ptr<char[]>> hoard;
        for (;;) hoard.emplace_back(new char[std::size_t{1} << 30]);
    });
    ASSERT_FALSE(samples);
    EXPECT_EQ(samples.error().text(), "x.h5: this file takes more memory than there is");
}

}  // namespace
}  // namespace corpuscle
