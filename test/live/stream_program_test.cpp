// corpuscle stream with real pipes and sockets, and what goes wrong with them: nothing crashes, nothing hangs, all is counted and told.

#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "io/spikes.hpp"
#include "stream_child.hpp"

namespace corpuscle {
namespace {

using test::sure;

TEST(StreamProgram, AnswersInPiecesAsInOneAndEachFrameWithoutWaitingForTheNext) {
    before();
    const Folder folder;
    Child whole(folder, with({"--quiet"}));
    whole.send(some_lines(1000)), whole.close_in();
    const auto wanted = whole.read_out();
    EXPECT_EQ(whole.wait(), 0);
    EXPECT_GT(wanted.size(), 300U);
    Child pieces(folder, with({"--quiet"}));
    const auto lines = some_lines(1000);
    pieces.send(lines.substr(0, 401)), pieces.send(lines.substr(401, 2));
    pollfd spikes = {pieces.out, POLLIN, 0};
    EXPECT_EQ(::poll(&spikes, 1, 10000), 1) << "spikes come while frames are still to come";
    for (std::size_t at = 403; at < lines.size(); at += 7) pieces.send(lines.substr(at, 7));
    pieces.close_in();
    EXPECT_EQ(pieces.read_out(), wanted);
    EXPECT_EQ(pieces.wait(), 0);
}

TEST(StreamProgram, AStateKeptByCtrlCIsGoneOnFromAsIfNothingHadBeen) {
    before();
    const Folder folder;
    Child whole(folder, with({"--format", "aer", "-o", folder / "whole.aer", "--quiet"}));
    whole.send(some_lines(1200)), whole.close_in();
    EXPECT_EQ(whole.wait(), 0) << whole.told();
    Child first(folder, with({"--format", "aer", "-o", folder / "first.aer", "--save-state", folder / "now.state"}));
    first.send(some_lines(700));
    int unread = 1;
    for (int k = 0; k < 2000 && unread > 0; ++k) {
        ::ioctl(first.in, FIONREAD, &unread);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // ... and answered
    first.interrupt();
    EXPECT_EQ(first.wait(), 130) << first.told();
    EXPECT_NE(first.told().find("700 frames of 700 ms"), std::string::npos) << first.told();
    Child second(folder, with({"--format", "aer", "-o", folder / "second.aer", "--resume", folder / "now.state", "--quiet"}));
    second.send(some_lines(500, 700)), second.close_in();
    EXPECT_EQ(second.wait(), 0) << second.told();
    const auto header = test::read_file(folder / "whole.aer").find("fa1") + 4;
    EXPECT_EQ(test::read_file(folder / "first.aer") + test::read_file(folder / "second.aer").substr(header),
              test::read_file(folder / "whole.aer"));
    Child other(folder, {"--rate", "2kHz", "--resume", folder / "now.state"});
    EXPECT_EQ(other.wait(), 1) << "another rate";
    EXPECT_NE(other.told().find("now.state: "), std::string::npos) << other.told();
}

TEST(StreamProgram, GarbageWrongWidthsAndHalfAFrameAreCountedAndTold) {
    before();
    const Folder folder;
    Child text(folder, with({"--channels", "2", "--out", "/dev/null"}));
    text.send("a,b\n1,2\nrubbish\n1\n1,2,3\nnan,1\n1e300,1\n\x01\xff\n1,");
    text.close_in();
    EXPECT_EQ(text.wait(), 0);
    for (const auto* said : {"3 frames of 7 ms", "4 frames could not be read", "2 forces no number", "1 half frame"})
        EXPECT_NE(text.told().find(said), std::string::npos) << said << "\n" << text.told();
    Child binary(folder, with({"--channels", "3", "--frames", "f64", "--stamp", "count", "--out", folder / "s.csv", "--json"}));
    std::string bytes(100 * 28 + 5, '\xff');  // NaN everywhere, always the same number
    binary.send(bytes), binary.close_in();
    const auto doc = nlohmann::json::parse(binary.read_out());
    EXPECT_EQ(binary.wait(), 0);
    EXPECT_EQ(doc["frames"], 1);
    EXPECT_EQ(doc["frames_in_order"]["duplicates"], 99);
    EXPECT_EQ(doc["frames_as_bytes"]["unreadable_forces"], 3);
    EXPECT_EQ(doc["frames_as_bytes"]["halves"], 1);
}

TEST(StreamProgram, AThousandClientsOneAfterAnotherSendTheirFrames) {
    before();
    const Folder folder;
    Child child(folder, with({"--in", "tcp:0", "--clients", "1000", "--out", folder / "s.csv", "--json"}));
    const int port = child.port();
    for (int k = 0; k < 1000; ++k) {
        const int fd = connected(port);
        const std::string_view text = k % 3 == 0 ? "2\n2" : k % 3 == 1 ? "2\n2\n" : "";  // some die within a frame, some at once
        EXPECT_EQ(::send(fd, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
        ::close(fd);
    }
    const auto doc = nlohmann::json::parse(child.read_out());
    EXPECT_EQ(child.wait(), 0);
    EXPECT_EQ(doc["frames_as_bytes"]["senders"], 1000);
    EXPECT_EQ(doc["frames_as_bytes"]["halves"], 334);
    EXPECT_EQ(doc["frames"], 334 + 2 * 333);
}

TEST(StreamProgram, FramesAnsweredTogetherGiveTheSpikesOfFramesOneByOne) {
    before();
    const Folder folder;
    std::vector<float> frames;  // 0.6 s of 1000 forces, of which the last are too few to go together
    for (int k = 0; k < 600; ++k)
        for (int s = 0; s < 1000; ++s) frames.push_back(k % 200 < 50 ? 0.0F : 0.002F * static_cast<float>(s));
    const std::string_view bytes(reinterpret_cast<const char*>(frames.data()), frames.size() * sizeof(float));
    const std::vector<std::string> words = {"--channels", "1000", "--frames", "f32", "--format", "aer", "--quiet"};
    Child alone(folder, with(words));
    std::thread feeding([&] { alone.send(bytes), alone.close_in(); });
    const auto wanted = alone.read_out();
    feeding.join();
    EXPECT_EQ(alone.wait(), 0) << alone.told();
    EXPECT_GT(wanted.size(), 50000U);
    auto together = words;
    together.insert(together.end(), {"--together", "16", "--clients", "1", "--in", "tcp:0"});
    together.erase(std::find(together.begin(), together.end(), "--quiet"));
    Child child(folder, with(together));
    const int fd = connected(child.port());
    std::thread sending([&] {
        for (std::size_t at = 0; at < bytes.size(); at += 333'333)  // neither whole frames nor whole groups
            EXPECT_GT(::send(fd, bytes.data() + at, std::min<std::size_t>(333'333, bytes.size() - at), 0), 0);
        ::close(fd);
    });
    EXPECT_EQ(child.read_out(), wanted);
    sending.join();
    EXPECT_EQ(child.wait(), 0) << child.told();
    EXPECT_NE(child.told().find("600 frames of 600 ms"), std::string::npos) << child.told();
}

TEST(StreamProgram, FramesTooFewToGoTogetherAreAnsweredWhenItIsInterrupted) {
    before();
    const Folder folder;
    Child child(folder, with({"--channels", "4", "--frames", "f64", "--together", "16", "--in", "tcp:0", "-o", folder / "s.csv"}));
    const int fd = connected(child.port());
    const std::array<double, 5 * 4> frames = {};
    EXPECT_EQ(::send(fd, frames.data(), sizeof frames, 0), static_cast<ssize_t>(sizeof frames));
    int unacknowledged = 1;
    for (int k = 0; k < 2000 && unacknowledged > 0; ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ::ioctl(fd, TIOCOUTQ, &unacknowledged);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // ... and its sender accepted
    child.interrupt();
    EXPECT_EQ(child.wait(), 130) << child.told();
    EXPECT_NE(child.told().find("5 frames of 5 ms"), std::string::npos) << child.told();
    ::close(fd);
}

TEST(StreamProgram, ASerialLineIsReadAsRawBytesUntilItHangsUp) {
    before();
    const Folder folder;
    int far = -1, near = -1;
    char name[128];
    if (::openpty(&far, &near, name, nullptr, nullptr) != 0) GTEST_SKIP() << test::no_terminals;
    ::fcntl(far, F_SETFD, FD_CLOEXEC), ::fcntl(near, F_SETFD, FD_CLOEXEC);
    Child whole(folder, with({"--quiet"}));
    whole.send(some_lines(500)), whole.close_in();
    const auto wanted = whole.read_out();
    EXPECT_EQ(whole.wait(), 0);
    Child child(folder, with({"--in", std::string("serial:") + name, "--baud", "115200"}));
    ASSERT_TRUE(child.said("serial line")) << child.told();
    const auto lines = some_lines(500);
    for (std::size_t at = 0; at < lines.size(); at += 100) {
        const auto piece = lines.substr(at, 100);
        EXPECT_EQ(::write(far, piece.data(), piece.size()), static_cast<ssize_t>(piece.size()));
    }
    std::string got;
    char some[4096];
    for (pollfd there = {child.out, POLLIN, 0}; got.size() < wanted.size() && ::poll(&there, 1, 10000) == 1;)
        got.append(some, static_cast<std::size_t>(::read(child.out, some, sizeof some)));
    EXPECT_EQ(got, wanted);
    termios ways = {};
    EXPECT_EQ(::tcgetattr(near, &ways), 0);
    EXPECT_EQ(::cfgetispeed(&ways), static_cast<speed_t>(B115200));
    EXPECT_EQ(ways.c_lflag & static_cast<tcflag_t>(ICANON | ECHO), 0U) << "no byte of a frame means anything to the line";
    ::close(near), ::close(far);  // the device is pulled out
    EXPECT_EQ(child.wait(), 0) << child.told();
    EXPECT_NE(child.told().find("500 frames of 500 ms"), std::string::npos) << child.told();
}

TEST(StreamProgram, ASlowReaderLosesWholeEventsAndNeverHoldsUpTheForce) {
    before();
    const Folder folder;
    Child child(folder, {"--rate", "1kHz", "--channels", "64", "--frames", "f64", "--format", "aer", "--buffer", "2k"});
    std::vector<double> frame(64);
    for (int k = 0; k < 20000; ++k) {  // nobody reads; every write here returns, or this would hang
        std::fill(frame.begin(), frame.end(), k / 100 % 2 == 0 ? 0.0 : 3.0);
        child.send({reinterpret_cast<const char*>(frame.data()), frame.size() * sizeof(double)});
    }
    child.close_in();
    const auto bytes = child.read_out();
    EXPECT_EQ(child.wait(), 0);
    EXPECT_NE(child.told().find("20000 frames of 20 s"), std::string::npos) << child.told();
    EXPECT_NE(child.told().find("left out: the reader was too slow"), std::string::npos) << child.told();
    const auto read = sure(read_spikes(folder.write("s.aer", bytes)));
    EXPECT_EQ(read.size(), 128U) << "every event that came is a whole one";
}

TEST(StreamProgram, AReaderThatGoesIsToldAndEndsIt) {
    before();
    const Folder folder;
    Child child(folder, with({}));
    child.send(some_lines(150));
    pollfd spikes = {child.out, POLLIN, 0};
    EXPECT_EQ(::poll(&spikes, 1, 10000), 1);
    child.close_out();
    child.send(some_lines(1000));
    EXPECT_EQ(child.wait(), 1) << child.told();
    EXPECT_NE(child.told().find("nobody reads standard output any more"), std::string::npos) << child.told();
}

TEST(StreamProgram, WhoListensMayGoAndComeBack) {
    before();
    const Folder folder;
    const auto [door, port] = listening();
    Child child(folder, with({"--to", std::to_string(port)}));
    int reader = ::accept(door, nullptr, nullptr);
    child.send(some_lines(400));
    char first = 0;
    EXPECT_EQ(::recv(reader, &first, 1, 0), 1);
    ::close(reader);
    for (int k = 0; k < 60 && ::poll(std::array<pollfd, 1>{{{door, POLLIN, 0}}}.data(), 1, 50) == 0; ++k) child.send(some_lines(400));
    reader = ::accept(door, nullptr, nullptr);
    char head[16] = {};
    child.send(some_lines(400));
    EXPECT_EQ(::recv(reader, head, sizeof head, MSG_WAITALL), 16);
    EXPECT_EQ(std::string_view(head, 16), "time_s,afferent\n") << "the header, again";
    child.close_in();
    EXPECT_EQ(child.wait(), 0) << child.told();
    EXPECT_NE(child.told().find("2 connections"), std::string::npos) << child.told();
    ::close(reader), ::close(door);
    Child alone(folder, with({"--to", std::to_string(port)}));
    EXPECT_EQ(alone.wait(), 1);
    EXPECT_NE(alone.told().find("cannot connect to 127.0.0.1:"), std::string::npos) << alone.told();
}

TEST(StreamProgram, GapsDuplicatesAndLateFramesKeepTheSamplesTime) {
    before();
    const Folder folder;
    const auto run = [&](const std::string& text, const std::string& hold) {
        Child child(folder, with({"--stamp", "count", "--hold", hold}));
        child.send(text), child.close_in();
        auto out = child.read_out();
        EXPECT_EQ(child.wait(), 0);
        return std::pair(out, child.told());
    };
    std::string whole, torn;
    for (int k = 0; k < 600; ++k) {
        const auto line = std::to_string(k) + "," + std::to_string(k / 100) + "\n";
        whole += line;
        if (k % 100 < 20 || k % 100 > 60) torn += line;
        if (k % 100 == 80) torn += line + std::to_string(k - 5) + ",7\n";
    }
    const auto [wanted, quiet] = run(whole, "1s");
    const auto [got, told] = run(torn, "1s");
    EXPECT_EQ(got, wanted) << "a force that does not change is held";
    EXPECT_GT(got.size(), 300U);
    for (const auto* said : {"6 gaps: 246 frames held, 0 without force", "6 duplicates left out", "6 late frames left out"})
        EXPECT_NE(told.find(said), std::string::npos) << told;
    EXPECT_NE(run(torn, "10ms").second.find("60 frames held, 186 without force"), std::string::npos);
}

TEST(StreamProgram, WordsThatCannotBeMeantAreRefused) {
    const Folder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"", "--rate is to be said"},
        {"--rate 1kHz --format aerr", "no format of events is called 'aerr'; did you mean 'aer'?"},
        {"--rate 1kHz --in tcp:99999", "write tcp:PORT"},
        {"--rate 1kHz --in serial:/dev/null", "this is no serial device"},
        {"--rate 1kHz --to 7000 -o x.csv", "spikes go to one of them"},
        {"--rate 1kHz --json", "--json prints on standard output"},
        {"--rate 1kHz --set sa1.nothing=1", "nothing"},
        {"--rate 1kHz --population 'grid 0x3'", "grid"},
        {"--in tcp:0 --rate 1kHz --listen 203.0.113.1", "cannot listen on 203.0.113.1:0"},
    };
    for (const auto& [words, said] : cases) {
        const auto ran = test::run(folder, std::string("stream ") + words + " </dev/null");
        EXPECT_NE(ran.status, 0) << words;
        EXPECT_NE(ran.err.find(said), std::string::npos) << words << ": " << ran.err;
    }
}

}  // namespace
}  // namespace corpuscle
