// A helper program that crashes, disconnects or is stopped causes an error and no other harm.

#include "io/sandbox/helper_process.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iterator>
#include <thread>

#include "io/sandbox/remote_samples.hpp"
#include "readers/helper_main.hpp"
#include "support/child_process.hpp"
#include "support/sanitized.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

/// The path of an executable shell script with these lines.
std::string script(const TemporaryFolder& folder, const std::string& lines) {
    const auto path = folder.write("script", "#!/bin/sh\n" + lines + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
}

std::string error_after(const std::string& lines) {
    const TemporaryFolder folder;
    auto helper = test::value_or_throw(HelperProcess::start(script(folder, lines), STDIN_FILENO));
    const auto message = helper.receive("x.h5", "the library");
    return message ? "a message was received" : message.error().text();
}

std::size_t open_descriptor_count() {
    std::size_t count = 0;
    DIR* all = ::opendir("/proc/self/fd");
    while (::readdir(all)) ++count;
    ::closedir(all);
    return count;
}

TEST(HelperProcess, TheReasonForItsEndIsReported) {
    EXPECT_EQ(error_after("kill -SEGV $$"), "x.h5: the library could not read this file (signal 11); it may be damaged");
    EXPECT_EQ(error_after("kill -ABRT $$"), "x.h5: the library could not read this file (signal 6); it may be damaged");
    EXPECT_EQ(error_after("exit 3"), "x.h5: the library could not read this file (status 3); it may be damaged");
    EXPECT_EQ(error_after("kill -ALRM $$"), "x.h5: the library did not read this file within 60 s; it may be damaged");
    EXPECT_EQ(error_after("kill -INT $$"), "x.h5: interrupted");
    EXPECT_NE(error_after("[ \"$1\" = reader-0 ] || exit 2")
                  .find("script belongs to another version of Corpuscle; install both from the same version"),
              std::string::npos);
}

TEST(HelperProcess, OneThatCannotBeStartedIsNamed) {
    const auto none = HelperProcess::start("/nowhere/corpuscle-hdf5", STDIN_FILENO);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().text(), "/nowhere/corpuscle-hdf5 cannot be started: No such file or directory");
    const TemporaryFolder folder;
    ::setenv("CORPUSCLE_LIBEXEC", folder.path().c_str(), 1);
    const auto missing = find_helper_program("corpuscle-hdf5");
    const auto before_creation = find_helper_program("script");
    const auto path = script(folder, "exit 0");
    const auto after_creation = find_helper_program("script");
    ::unsetenv("CORPUSCLE_LIBEXEC");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().text(), "the program 'corpuscle-hdf5', which reads this format, was not found in " + folder.path() +
                                          "; set CORPUSCLE_LIBEXEC to its directory");
    EXPECT_FALSE(before_creation);
    EXPECT_EQ(test::value_or_throw(after_creation), path);
}

TEST(HelperProcess, InheritsNoDescriptorsAndLeavesNothingBehind) {
    const TemporaryFolder folder;
    const auto leaked = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC, as some libraries open files
    ::setenv("CORPUSCLE_SECRET", "x", 1);
    const auto program = script(folder, "ls /proc/$$/fd >listed; env >environment; mv listed listed.whole; exec sleep 30");
    const auto original_folder = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const auto before = open_descriptor_count();
    {
        auto first = test::value_or_throw(HelperProcess::start(program, leaked));
        while (!std::filesystem::exists("listed.whole")) ::usleep(1000);
        std::istringstream listed(test::read_file("listed.whole"));
        std::vector<int> descriptors{std::istream_iterator<int>(listed), {}};
        std::erase_if(descriptors, [](int number) { return number >= 10; });  // the shell's own descriptor of its script
        std::sort(descriptors.begin(), descriptors.end());
        EXPECT_EQ(descriptors, (std::vector<int>{0, 1, 2, 3, 4}));
        EXPECT_EQ(test::read_file("environment").find("CORPUSCLE_SECRET"), std::string::npos);
        auto second = std::move(first);
        EXPECT_TRUE(test::signal_child(second.pid(), 0));
    }
    EXPECT_EQ(open_descriptor_count(), before);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    std::filesystem::current_path(original_folder);
    ::unsetenv("CORPUSCLE_SECRET");
    ::close(leaked);
}

/// A message with its length before it, as it is sent.
std::string framed(const std::string& m) {
    const std::uint64_t size = m.size();
    return std::string(reinterpret_cast<const char*>(&size), sizeof size) + m;
}

TEST(HelperProcess, ACrashDuringReadingIsAnErrorInEveryLaterRead) {
    const TemporaryFolder folder;
    folder.write("answers", framed(encode(SamplesInfo{{.columns = {{"fz", "N"}}, .rate = 100.0, .notes = {"a remark"}}, 10})) +
                                framed(encode(std::vector<std::vector<double>>{{7.0}})));
    const auto program = script(folder, "cat '" + folder / "answers" + "' >&3; kill -BUS $$");
    auto samples = test::value_or_throw(open_remote_samples_with(program, folder.write("x.h5", ""), {"", "it"}));
    EXPECT_EQ(samples->info().columns.at(0).unit, "N");
    EXPECT_EQ(samples->info().rate, 100);
    EXPECT_EQ(samples->info().notes, std::vector<std::string>{"a remark"});
    const std::vector<std::size_t> column_numbers = {0};
    std::vector<std::vector<double>> out(1, std::vector<double>(1));
    EXPECT_TRUE(samples->fetch(0, 1, column_numbers, out));
    EXPECT_EQ(out[0][0], 7);
    EXPECT_EQ(samples->fetch(1, 1, column_numbers, out).error().text(),
              folder / "x.h5" + ": it could not read this file (signal 7); it may be damaged");
    EXPECT_FALSE(samples->fetch(1, 1, column_numbers, out));
}

TEST(HelperProcess, ADamagedMessageIsAnError) {
    const TemporaryFolder folder;
    SamplesInfo info{{.columns = {{"fz", "N"}}, .time_column = 5, .rate = 100.0}, 10};
    std::vector<std::string> messages = {framed(encode(info)), framed("xx"), framed(std::string(8, '\x7f'))};
    info.time_column.reset();
    const auto complete = encode(info);
    for (const std::size_t size : {9U, 20U, 33U, 50U}) messages.push_back(framed(complete.substr(0, size)));
    for (const auto& message : messages) {
        folder.write("answer", message);
        const auto program = script(folder, "cat '" + folder / "answer" + "' >&3; exec sleep 30");
        const auto made = open_remote_samples_with(program, folder.write("x.h5", ""), {"", "it"});
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().text(), folder / "x.h5" + ": invalid response of the helper process that reads this file");
    }
}

/// The first response of a helper in which the library throws this exception.
template <class Thrown>
std::string error_after_throw(const Thrown& thrown) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return "no socket";
    std::thread program(
        [&] { samples_service([&](int, const std::string&, const TableOptions&) -> SamplesResult { throw thrown; }).serve(ends[1], -1); });
    std::string message;
    const bool has_message = send_message(ends[0], encode(OpenRequest{"x.h5", {}})) && receive_message(ends[0], message);
    program.join();
    ::close(ends[0]), ::close(ends[1]);
    const auto info = decode_info(message, "x.h5");
    return has_message && !info ? info.error().text() : "no error";
}

TEST(HelperProcess, EveryExceptionInItIsAnError) {
    EXPECT_EQ(error_after_throw(std::bad_alloc()), "x.h5: not enough memory for this file");
    EXPECT_EQ(error_after_throw(std::runtime_error("no end")), "x.h5: cannot be read: no end");
    EXPECT_EQ(error_after_throw(3), "x.h5: cannot be read");
}

/// The operations that a confined process can still do, one bit each.
unsigned allowed_operations() {
    unsigned bits = 0;
    if (::open("/etc/passwd", O_RDONLY) >= 0) bits |= 1;
    if (::open(".", O_RDONLY | O_DIRECTORY) >= 0) bits |= 2;
    if (::socket(AF_INET, SOCK_STREAM, 0) >= 0) bits |= 4;
    if (::dup(0) >= 0) bits |= 8;
    if (::rename("/nowhere/a", "/nowhere/b") != 0 && errno == ENOENT) bits |= 16;  // seccomp would refuse the call itself
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    if (child > 0) bits |= 32;
    return bits;
}

bool kernel_filters_calls() { return ::prctl(PR_GET_SECCOMP) >= 0; }

TEST(HelperProcess, GivesUpRightsThatItDoesNotNeedAndRaisesNoLimit) {
    if (test::is_sanitized) GTEST_SKIP() << "sanitizers need more address space than this limit";
    int report_pipe[2], wait_pipe[2];
    ASSERT_EQ(::pipe(report_pipe), 0);
    ASSERT_EQ(::pipe(wait_pipe), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::close(wait_pipe[1]);  // so that the read below ends when the parent closes the pipe or dies
        const rlimit lower{std::uint64_t{3} << 30, std::uint64_t{3} << 30};
        ::setrlimit(RLIMIT_AS, &lower);
        confine(HelperProcess::file_descriptor, HelperProcess::memory_limit, FileAccess::read);
        const unsigned bits = allowed_operations();
        char end;
        if (::write(report_pipe[1], &bits, sizeof bits) == sizeof bits) (void)!::read(wait_pipe[0], &end, 1);
        ::_exit(0);
    }
    unsigned bits = ~0U;
    EXPECT_EQ(::read(report_pipe[0], &bits, sizeof bits), static_cast<ssize_t>(sizeof bits));
    EXPECT_EQ(bits & 15U, 0U);
    if (kernel_filters_calls()) {
        EXPECT_EQ(bits, 0U);
    }
    const auto limits = test::read_file(fmt::format("/proc/{}/limits", child));
    EXPECT_NE(limits.find("Max address space         3221225472           3221225472"), std::string::npos) << limits;
    EXPECT_NE(limits.find("Max core file size        0                    0"), std::string::npos);
    for (const int end : {report_pipe[0], report_pipe[1], wait_pipe[0], wait_pipe[1]}) ::close(end);
    EXPECT_EQ(::waitpid(child, nullptr, 0), child);
}

}  // namespace
}  // namespace corpuscle
