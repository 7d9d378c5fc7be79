// corpuscle stream with real pipes, sockets and their failures: it never crashes or hangs, and counts and reports all losses.

#include <fmt/format.h>

#include <netinet/tcp.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "io/spikes/spike_files.hpp"
#include "live/input/sockets.hpp"
#include "stream_child.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

TEST(StreamProgram, GivesTheSameSpikesForAnyChunksAndRespondsImmediately) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child undivided(folder, with_base_options({"--quiet"}));
    undivided.send(force_lines(1000)), undivided.close_in();
    const auto expected = undivided.read_out();
    EXPECT_EQ(undivided.wait(), 0);
    EXPECT_GT(expected.size(), 300U);
    Child chunked(folder, with_base_options({"--quiet"}));
    const auto lines = force_lines(1000);
    chunked.send(lines.substr(0, 401)), chunked.send(lines.substr(401, 2));
    pollfd spikes = {chunked.out, POLLIN, 0};
    EXPECT_EQ(::poll(&spikes, 1, 10000), 1) << "spikes arrive before the last frames are sent";
    for (std::size_t at = 403; at < lines.size(); at += 7) chunked.send(lines.substr(at, 7));
    chunked.close_in();
    EXPECT_EQ(chunked.read_out(), expected);
    EXPECT_EQ(chunked.wait(), 0);
}

TEST(StreamProgram, AStateSavedOnCtrlCIsResumedExactly) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child undivided(folder, with_base_options({"--format", "aer", "-o", folder / "whole.aer", "--quiet"}));
    undivided.send(force_lines(1200)), undivided.close_in();
    EXPECT_EQ(undivided.wait(), 0) << undivided.error_text();
    Child first(folder, with_base_options({"--format", "aer", "-o", folder / "first.aer", "--save-state", folder / "now.state"}));
    first.send(force_lines(700));
    int unread = 1;
    for (int k = 0; k < 2000 && unread > 0; ++k) {
        ::ioctl(first.in, FIONREAD, &unread);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until the frames that have been read are processed
    first.interrupt();
    EXPECT_EQ(first.wait(), 130) << first.error_text();
    EXPECT_NE(first.error_text().find("700 frames (700 ms of force)"), std::string::npos) << first.error_text();
    Child second(folder, with_base_options({"--format", "aer", "-o", folder / "second.aer", "--resume", folder / "now.state", "--quiet"}));
    second.send(force_lines(500, 700)), second.close_in();
    EXPECT_EQ(second.wait(), 0) << second.error_text();
    const auto header = test::read_file(folder / "whole.aer").find("fa1") + 4;
    EXPECT_EQ(test::read_file(folder / "first.aer") + test::read_file(folder / "second.aer").substr(header),
              test::read_file(folder / "whole.aer"));
    Child other(folder, {"--rate", "2kHz", "--resume", folder / "now.state"});
    EXPECT_EQ(other.wait(), 1) << "a state saved at another rate";
    EXPECT_NE(other.error_text().find("now.state: "), std::string::npos) << other.error_text();
}

TEST(StreamProgram, InvalidBytesWrongWidthsAndIncompleteFramesAreCountedAndReported) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child text(folder, with_base_options({"--channels", "2", "--out", "/dev/null"}));
    text.send("a,b\n1,2\nrubbish\n1\n1,2,3\nnan,1\n1e300,1\n\x01\xff\n1,");
    text.close_in();
    EXPECT_EQ(text.wait(), 0);
    for (const auto* message : {"3 frames (7 ms of force)", "4 frames unreadable", "2 readings invalid", "1 incomplete frame"})
        EXPECT_NE(text.error_text().find(message), std::string::npos) << message << "\n" << text.error_text();
    Child binary(folder,
                 with_base_options({"--channels", "3", "--frames", "f64", "--stamp", "sequence", "--out", folder / "s.csv", "--json"}));
    std::string bytes(100 * 28 + 5, '\xff');  // all forces are NaN, and all frame numbers are equal
    binary.send(bytes), binary.close_in();
    const auto doc = nlohmann::json::parse(binary.read_out());
    EXPECT_EQ(binary.wait(), 0);
    EXPECT_EQ(doc["frames"], 1);
    EXPECT_EQ(doc["sequence"]["duplicates"], 99);
    EXPECT_EQ(doc["input"]["invalid_values"], 3);
    EXPECT_EQ(doc["input"]["incomplete"], 1);
}

TEST(StreamProgram, AThousandClientsOneAfterAnotherSendTheirFrames) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder, with_base_options({"--in", "tcp:0", "--clients", "1000", "--out", folder / "s.csv", "--json"}));
    const int port = child.port();
    for (int k = 0; k < 1000; ++k) {
        const int fd = connect_to(port);
        const std::string_view text = k % 3 == 0 ? "2\n2" : k % 3 == 1 ? "2\n2\n" : "";  // some disconnect within a frame, some at once
        EXPECT_EQ(::send(fd, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
        ::close(fd);
    }
    const auto doc = nlohmann::json::parse(child.read_out());
    EXPECT_EQ(child.wait(), 0);
    EXPECT_EQ(doc["input"]["senders"], 1000);
    EXPECT_EQ(doc["input"]["incomplete"], 334);
    EXPECT_EQ(doc["frames"], 334 + 2 * 333);
}

TEST(StreamProgram, FramesInBatchesGiveTheSpikesOfSingleFrames) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    std::vector<float> frames;  // 600 frames of 1000 forces; the last 8 are too few for a batch
    for (int k = 0; k < 600; ++k)
        for (int s = 0; s < 1000; ++s) frames.push_back(k % 200 < 50 ? 0.0F : 0.002F * static_cast<float>(s));
    const std::string_view bytes(reinterpret_cast<const char*>(frames.data()), frames.size() * sizeof(float));
    const std::vector<std::string> options = {"--channels", "1000", "--frames", "f32", "--format", "aer", "--quiet"};
    Child unbatched(folder, with_base_options(options));
    std::thread feeding([&] { unbatched.send(bytes), unbatched.close_in(); });
    const auto expected = unbatched.read_out();
    feeding.join();
    EXPECT_EQ(unbatched.wait(), 0) << unbatched.error_text();
    EXPECT_GT(expected.size(), 50000U);
    auto batch_options = options;
    batch_options.insert(batch_options.end(), {"--batch-frames", "16", "--clients", "1", "--in", "tcp:0"});
    batch_options.erase(std::find(batch_options.begin(), batch_options.end(), "--quiet"));
    Child child(folder, with_base_options(batch_options));
    const int fd = connect_to(child.port());
    std::thread sending([&] {
        for (std::size_t at = 0; at < bytes.size(); at += 333'333)  // neither complete frames nor complete batches
            EXPECT_GT(::send(fd, bytes.data() + at, std::min<std::size_t>(333'333, bytes.size() - at), 0), 0);
        ::close(fd);
    });
    EXPECT_EQ(child.read_out(), expected);
    sending.join();
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_NE(child.error_text().find("600 frames (600 ms of force)"), std::string::npos) << child.error_text();
}

TEST(StreamProgram, AnIncompleteBatchIsProcessedAtAnInterrupt) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder,
                with_base_options({"--channels", "4", "--frames", "f64", "--batch-frames", "16", "--in", "tcp:0", "-o", folder / "s.csv"}));
    const int fd = connect_to(child.port());
    const std::array<double, 5 * 4> frames = {};
    EXPECT_EQ(::send(fd, frames.data(), sizeof frames, 0), static_cast<ssize_t>(sizeof frames));
    int unacknowledged = 1;
    for (int k = 0; k < 2000 && unacknowledged > 0; ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ::ioctl(fd, TIOCOUTQ, &unacknowledged);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until the sender has been accepted
    child.interrupt();
    EXPECT_EQ(child.wait(), 130) << child.error_text();
    EXPECT_NE(child.error_text().find("5 frames (5 ms of force)"), std::string::npos) << child.error_text();
    ::close(fd);
}

TEST(StreamProgram, ASerialLineIsReadAsRawBytesUntilItIsDisconnected) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    int far = -1, near = -1;
    char name[128];
    if (::openpty(&far, &near, name, nullptr, nullptr) != 0) GTEST_SKIP() << test::no_pseudo_terminals;
    ::fcntl(far, F_SETFD, FD_CLOEXEC), ::fcntl(near, F_SETFD, FD_CLOEXEC);
    Child by_pipe(folder, with_base_options({"--quiet"}));
    by_pipe.send(force_lines(500)), by_pipe.close_in();
    const auto expected = by_pipe.read_out();
    EXPECT_EQ(by_pipe.wait(), 0);
    Child child(folder, with_base_options({"--in", std::string("serial:") + name, "--baud", "115200"}));
    ASSERT_TRUE(child.wait_for_text("serial line")) << child.error_text();
    const auto lines = force_lines(500);
    for (std::size_t at = 0; at < lines.size(); at += 100) {
        const auto chunk = lines.substr(at, 100);
        EXPECT_EQ(::write(far, chunk.data(), chunk.size()), static_cast<ssize_t>(chunk.size()));
    }
    std::string received;
    char chunk[4096];
    for (pollfd spikes = {child.out, POLLIN, 0}; received.size() < expected.size() && ::poll(&spikes, 1, 10000) == 1;)
        received.append(chunk, static_cast<std::size_t>(::read(child.out, chunk, sizeof chunk)));
    EXPECT_EQ(received, expected);
    termios settings = {};
    EXPECT_EQ(::tcgetattr(near, &settings), 0);
    EXPECT_EQ(::cfgetispeed(&settings), static_cast<speed_t>(B115200));
    EXPECT_EQ(settings.c_lflag & static_cast<tcflag_t>(ICANON | ECHO), 0U) << "the terminal interprets no byte of a frame";
    ::close(near), ::close(far);  // the device is unplugged
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_NE(child.error_text().find("500 frames (500 ms of force)"), std::string::npos) << child.error_text();
}

TEST(StreamProgram, ASlowReaderLosesCompleteEventsAndNeverDelaysTheForce) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder, {"--rate", "1kHz", "--channels", "64", "--frames", "f64", "--format", "aer", "--buffer", "2k"});
    std::vector<double> frame(64);
    for (int k = 0; k < 20000; ++k) {  // no process reads the spikes; every write here must return, or the test would hang
        std::fill(frame.begin(), frame.end(), k / 100 % 2 == 0 ? 0.0 : 3.0);
        child.send({reinterpret_cast<const char*>(frame.data()), frame.size() * sizeof(double)});
    }
    child.close_in();
    const auto bytes = child.read_out();
    EXPECT_EQ(child.wait(), 1) << "dropped spikes are an error";
    EXPECT_NE(child.error_text().find("--allow-drops"), std::string::npos) << child.error_text();
    EXPECT_NE(child.error_text().find("20000 frames (20 s of force)"), std::string::npos) << child.error_text();
    EXPECT_NE(child.error_text().find("dropped: the receiver was too slow"), std::string::npos) << child.error_text();
    const auto read = value_or_throw(read_spikes(folder.write("s.aer", bytes)));
    EXPECT_EQ(read.size(), 128U) << "every received event is complete";
}

TEST(StreamProgram, AReaderThatDisconnectsIsReportedAndEndsTheStream) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder, with_base_options({}));
    child.send(force_lines(150));
    pollfd spikes = {child.out, POLLIN, 0};
    EXPECT_EQ(::poll(&spikes, 1, 10000), 1);
    child.close_out();
    child.send(force_lines(1000));
    EXPECT_EQ(child.wait(), 1) << child.error_text();
    EXPECT_NE(child.error_text().find("the reader of standard output has closed it"), std::string::npos) << child.error_text();
}

TEST(StreamProgram, AReaderMayDisconnectAndReconnect) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto [listener, port] = listen_on();
    Child child(folder, with_base_options({"--to", std::to_string(port), "--allow-drops"}));
    int reader = ::accept(listener, nullptr, nullptr);
    child.send(force_lines(400));
    char first = 0;
    EXPECT_EQ(::recv(reader, &first, 1, 0), 1);
    ::close(reader);
    for (int k = 0; k < 60 && ::poll(std::array<pollfd, 1>{{{listener, POLLIN, 0}}}.data(), 1, 50) == 0; ++k) child.send(force_lines(400));
    reader = ::accept(listener, nullptr, nullptr);
    char head[24] = {};
    child.send(force_lines(400));
    EXPECT_EQ(::recv(reader, head, sizeof head, MSG_WAITALL), 24);
    EXPECT_EQ(std::string_view(head, 24), "afferent,channel,time_s\n") << "the header is sent again";
    child.close_in();
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_NE(child.error_text().find("2 connections"), std::string::npos) << child.error_text();
    ::close(reader), ::close(listener);
    Child without_reader(folder, with_base_options({"--to", std::to_string(port)}));
    EXPECT_EQ(without_reader.wait(), 1);
    EXPECT_NE(without_reader.error_text().find("cannot connect to 127.0.0.1:"), std::string::npos) << without_reader.error_text();
}

TEST(StreamProgram, GapsDuplicatesAndLateFramesDoNotShiftTheTime) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto run = [&](const std::string& text, const std::string& hold) {
        Child child(folder, with_base_options({"--stamp", "sequence", "--hold", hold}));
        child.send(text), child.close_in();
        auto out = child.read_out();
        EXPECT_EQ(child.wait(), 0);
        return std::pair(out, child.error_text());
    };
    std::string complete, with_gaps;
    for (int k = 0; k < 600; ++k) {
        const auto line = std::to_string(k) + "," + std::to_string(k / 100) + "\n";
        complete += line;
        if (k % 100 < 20 || k % 100 > 60) with_gaps += line;
        if (k % 100 == 80) with_gaps += line + std::to_string(k - 5) + ",7\n";
    }
    const auto [expected, no_errors] = run(complete, "1s");
    const auto [received, errors] = run(with_gaps, "1s");
    EXPECT_EQ(received, expected) << "the force is constant during each gap, so the last force replaces the missing frames";
    EXPECT_GT(received.size(), 300U);
    for (const auto* message :
         {"6 gaps: 246 frames filled by the last force, 0 by zero force", "6 duplicate frames ignored", "6 late frames ignored"})
        EXPECT_NE(errors.find(message), std::string::npos) << errors;
    EXPECT_NE(run(with_gaps, "10ms").second.find("60 frames filled by the last force, 186 by zero force"), std::string::npos);
}

// --- no event is dropped where frames can wait

/// A recording whose force changes at every sample and channel, which gives many spikes from few frames.
std::string noisy_recording(int samples, int channels) {
    std::string text;
    for (int c = 0; c < channels; ++c) text += (c > 0 ? ",f" : "f") + std::to_string(c) + "_N";
    text += "\n";
    for (int k = 0; k < samples; ++k) {
        for (int c = 0; c < channels; ++c) text += (c > 0 ? "," : "") + std::to_string((k * 7 + c * 3) % 5);
        text += "\n";
    }
    return text;
}

TEST(StreamProgram, ARecordingToAFileDropsNoSpikeWithASmallBuffer) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto recording = folder.write("touch.csv", noisy_recording(3000, 8));
    const auto spikes = [&](const std::string& file, const std::string& buffer) {
        const auto ran =
            test::run_program(folder, "stream --in " + recording + " --rate 1kHz --scale 20 --pace fast --format aer --json --buffer " +
                                          buffer + " -o " + folder / file);
        EXPECT_EQ(ran.status, 0) << ran.err;
        const auto doc = nlohmann::json::parse(ran.out);
        EXPECT_EQ(doc["events"]["dropped"], 0);
        EXPECT_EQ(doc["events"]["undelivered"], 0);
        EXPECT_TRUE(doc["input_rate_Hz"].is_null()) << "with --pace fast there is no input rate";
        return doc["spikes"].get<std::size_t>();
    };
    const auto count = spikes("small.aer", "1k");
    EXPECT_GT(count * 16, 100'000U) << "many times the size of the buffer, in bytes";
    EXPECT_EQ(spikes("large.aer", "100M"), count);
    EXPECT_EQ(test::read_file(folder / "small.aer"), test::read_file(folder / "large.aer"));
}

TEST(StreamProgram, ARecordingWaitsForASlowReader) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto recording = folder.write("touch.csv", noisy_recording(3000, 8));
    const std::vector<std::string> options = {"--in",   recording, "--rate",   "1kHz", "--scale",  "20",
                                              "--pace", "fast",    "--buffer", "1k",   "--format", "aer"};
    Child child(folder, options);
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // longer than the stream waits for a live reader at the end
    const auto bytes = child.read_out();
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_EQ(child.error_text().find("dropped"), std::string::npos) << child.error_text();
    EXPECT_EQ(child.error_text().find("ignored"), std::string::npos) << child.error_text();
    EXPECT_EQ(child.error_text().find("input rate"), std::string::npos) << child.error_text();
    EXPECT_NE(child.error_text().find("3000 frames (3 s of force)"), std::string::npos) << child.error_text();
    Child again(folder, options);
    EXPECT_EQ(again.read_out(), bytes);
    EXPECT_EQ(again.wait(), 0);
    Child stopped(folder, options);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the stream now waits for this test to read
    stopped.interrupt();
    EXPECT_EQ(stopped.wait(), 130) << "a reader that reads nothing does not delay Ctrl-C: " << stopped.error_text();
}

TEST(StreamProgram, AFileOnStandardInputWaitsForTheWriterLikeARecording) {
    const TemporaryFolder folder;
    std::string frames;
    for (int k = 0; k < 20000; ++k) frames += std::to_string((k * 7) % 5) + "\n";
    const auto ran =
        test::run_program(folder, "stream --rate 1kHz --buffer 1k -o " + (folder / "spikes.csv") + " < " + folder.write("frames", frames));
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err.find("dropped"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("ignored"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("input rate"), std::string::npos) << "a file has no input rate: " << ran.err;
}

TEST(StreamProgram, OnlyFramesThatArriveOneByOneHaveAnInputRate) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child bulk(folder, with_base_options({"--json", "-o", folder / "a.csv"}));
    bulk.send(force_lines(100'000)), bulk.close_in();
    const auto in_bulk = nlohmann::json::parse(bulk.read_out());
    EXPECT_EQ(bulk.wait(), 0);
    EXPECT_TRUE(in_bulk["input_rate_Hz"].is_null() && in_bulk["jitter_s"].is_null()) << in_bulk;
    Child clocked(folder, with_base_options({"--json", "-o", folder / "b.csv"}));
    while (!std::filesystem::exists(folder / "b.csv.part")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (int k = 0; k < 50; ++k) clocked.send("1\n"), std::this_thread::sleep_for(std::chrono::milliseconds(5));
    clocked.close_in();
    const auto by_clock = nlohmann::json::parse(clocked.read_out());
    EXPECT_EQ(clocked.wait(), 0);
    EXPECT_GT(by_clock["input_rate_Hz"].get<double>(), 0) << by_clock;
}

// --- recordings

TEST(StreamProgram, ARecordingIsReadWithTheOptionsAndWarningsOfRespond) {
    const TemporaryFolder folder;
    std::string text = "time,fz_N\n";
    for (int k = 0; k < 3000; ++k) text += std::to_string(k) + "," + (k % 1000 < 200 ? "0" : k == 1500 ? "900" : "2") + "\n";
    const auto recording = folder.write("touch.csv", text);
    const std::string options = " --channel fz --despike 100 --range 0..500 --scale 0.5";
    const auto offline = test::run_program(folder, "respond " + recording + options + " --time-unit ms -o " + (folder / "answer"));
    ASSERT_EQ(offline.status, 0) << offline.err;
    const auto live =
        test::run_program(folder, "stream --in " + recording + options + " --time-unit ms --pace fast -o " + (folder / "live.csv"));
    ASSERT_EQ(live.status, 0) << live.err;
    const auto compared = test::run_program(folder, "compare answer/spikes.csv live.csv --json");
    ASSERT_EQ(compared.status, 0) << "trains have the same names: " << compared.err;
    const auto doc = nlohmann::json::parse(compared.out);
    EXPECT_GT(doc["total"]["matched"], 10);
    EXPECT_EQ(doc["total"]["missing"], 0);
    EXPECT_EQ(doc["total"]["extra"], 0);
    const auto lines = [&](const std::string& command) {
        std::vector<std::string> out;
        std::istringstream err(test::run_program(folder, command).err);
        for (std::string line; std::getline(err, line);)
            if (line.find("touch: ") != std::string::npos) out.push_back(line);
        return out;
    };
    const auto warnings = lines("respond " + recording + " --time-unit ms");
    EXPECT_FALSE(warnings.empty());
    EXPECT_EQ(lines("stream --in " + recording + " --time-unit ms --pace fast -o " + (folder / "x.csv")), warnings);
}

// --- frames of another width

TEST(StreamProgram, TheErrorForTheFirstFrameOfTheWrongWidthNamesTheExpectedWidth) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder, {"--population", "grid 8x8", "--rate", "1kHz"});
    child.send("1,2,3,4\n");
    EXPECT_TRUE(child.wait_for_text("frame 1 has 4 numbers; 'grid 8x8' has 64 ")) << "at once: " << child.error_text();
    EXPECT_TRUE(child.wait_for_text("use --layout FILE to map")) << child.error_text();
    child.close_in();
    EXPECT_EQ(child.wait(), 1);
    EXPECT_TRUE(child.wait_for_text("no valid frame from standard input: frame 1 has 4 numbers")) << child.error_text();
    Child binary(folder, with_base_options({"--channels", "16", "--frames", "f32"}));
    binary.send("abcdefgh"), binary.close_in();
    EXPECT_EQ(binary.wait(), 1);
    EXPECT_TRUE(binary.wait_for_text("no complete frame from standard input: received 8 bytes, but a frame of 'sa1,fa1' (16 sites) has 64"))
        << binary.error_text();
    Child nothing(folder, base_options);
    nothing.close_in();
    EXPECT_EQ(nothing.wait(), 1);
    EXPECT_TRUE(nothing.wait_for_text("no frame from standard input")) << nothing.error_text();
    Child stamped(folder, with_base_options({"--channels", "2", "--stamp", "sequence"}));
    stamped.send("1,1,1\n2.5,1,1\n"), stamped.close_in();
    EXPECT_EQ(stamped.wait(), 0);
    EXPECT_TRUE(stamped.wait_for_text("frame 2 does not begin with its sequence number, an integer")) << stamped.error_text();
}

// --- names in the header

/// Frames of a grid of four sites, with this header: 50 ms without force, then 3 N in one column, 0.5 s in total.
std::string pressed(const std::string& header, std::size_t column) {
    std::string text = header + "\n";
    for (int k = 0; k < 500; ++k)
        for (std::size_t c = 0; c < 4; ++c) text += fmt::format("{}{}", c == column && k > 50 ? 3 : 0, c == 3 ? '\n' : ',');
    return text;
}

const std::vector<std::string> small_grid = {"--population", "grid 2x2", "--rate", "1kHz"};

TEST(StreamProgram, NamesInTheHeaderDetermineTheSiteOfEachColumn) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto spikes_of = [&](const std::string& text, std::vector<std::string> more = {}) {
        auto options = small_grid;
        options.insert(options.end(), more.begin(), more.end());
        Child child(folder, options);
        child.send(text), child.close_in();
        auto out = child.read_out();
        EXPECT_EQ(child.wait(), 0) << child.error_text();
        return out;
    };
    const auto in_order = spikes_of(pressed("r1c1,r1c2,r2c1,r2c2", 2));
    EXPECT_NE(in_order.find("sa1#3,"), std::string::npos) << in_order;
    EXPECT_EQ(spikes_of(pressed("r2c2_N,r2c1_N,r1c1_N,r1c2_N", 1)), in_order);
    EXPECT_EQ(spikes_of(pressed("\"r2c1\";r2c2;r1c1;r1c2", 0)), in_order);
    EXPECT_EQ(spikes_of(pressed("north,east,south,west", 2)), in_order) << "no name is a site, so the columns are the sites in order";
    folder.write("turned.csv", "channel,name\n1,r2c1\n2,r1c1\n3,r1c2\n4,r2c2\n");
    EXPECT_EQ(spikes_of(pressed("a,b,c,d", 0), {"--layout", folder / "turned.csv"}), in_order);
    EXPECT_EQ(spikes_of(pressed("r2c1,r1c1,r1c2,r2c2", 0), {"--layout", folder / "turned.csv"}), in_order);
}

TEST(StreamProgram, AHeaderWithAnUnknownOrRepeatedSiteOrThatContradictsTheLayoutIsRefused) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    folder.write("turned.csv", "channel,name\n1,r2c1\n2,r1c1\n3,r1c2\n4,r2c2\n");
    const auto refused = [&](const std::string& header, const std::string& message, std::vector<std::string> more = {}) {
        auto options = small_grid;
        options.insert(options.end(), more.begin(), more.end());
        Child child(folder, options);
        child.send(pressed(header, 0));  // the sender stays connected, which must not delay the end
        EXPECT_EQ(child.wait(), 1) << child.error_text();
        EXPECT_TRUE(child.wait_for_text(message)) << child.error_text();
        EXPECT_EQ(child.error_text().find("unreadable"), std::string::npos) << child.error_text();
    };
    refused("r1c1,r1c2,r2cl,r2c2", "header: there is no site 'r2cl'; did you mean 'r2c1'");
    refused("r1c1,r1c2,r1c1,r2c2", "header: two channels have the name 'r1c1', which is one site");
    refused("r1c1,r1c2,r2c1,r2c2", "column 1 is site 'r1c1' in the header, but 'r2c1' in", {"--layout", folder / "turned.csv"});
}

TEST(StreamProgram, AWrongHeaderOfOneSenderDoesNotEndTheStreamOfOthers) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    auto options = small_grid;
    options.insert(options.end(), {"--in", "tcp:0", "--clients", "2", "--json", "-o", folder / "x.csv"});
    Child child(folder, options);
    const int port = child.port();
    const auto send = [&](const std::string& text) {
        const int client = connect_to(port);
        EXPECT_EQ(::write(client, text.data(), text.size()), static_cast<ssize_t>(text.size()));
        ::close(client);
    };
    send(pressed("r1c1,r1c2,r2cl,r2c2", 0));
    send(pressed("r2c2,r2c1,r1c1,r1c2", 1));
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_TRUE(child.wait_for_text("there is no site 'r2cl'; did you mean 'r2c1'")) << child.error_text();
    const auto spikes = test::read_file(folder / "x.csv");
    EXPECT_NE(spikes.find("sa1#3,"), std::string::npos) << spikes;
    EXPECT_EQ(spikes.find("sa1#1,"), std::string::npos) << spikes;
}

TEST(StreamProgram, ChannelsOfARecordingAreAssignedToTheSitesOfTheirNamesOrRefused) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto recorded = [&](const std::string& header) {
        std::string text = "time_s," + header + "\n";
        for (int k = 0; k < 500; ++k) text += fmt::format("{:.3f},{},0,0,0\n", 0.001 * k, k > 50 ? 3 : 0);
        folder.write("x.csv", text);
        return test::run_program(folder, "stream --in x.csv --population 'grid 2x2' --pace fast");
    };
    const auto in_order = recorded("r1c1,r1c2,r2c1,r2c2"), reversed = recorded("r2c2,r2c1,r1c1,r1c2"), other_names = recorded("a,b,c,d");
    EXPECT_NE(in_order.out.find("sa1#1,"), std::string::npos) << in_order.err;
    EXPECT_NE(reversed.out.find("sa1#4,"), std::string::npos) << reversed.err;
    EXPECT_EQ(other_names.out, in_order.out);
    for (const auto& [header, message] :
         {std::pair{"r2c2,r2c1,r2c2,r1c2", "x: two channels have the name 'r2c2', which is one site; --layout FILE"},
          {"r2c2,r2cl,r1c1,r1c2", "x: there is no site 'r2cl'; did you mean 'r2c1'"}}) {
        const auto refused = recorded(header);
        EXPECT_EQ(refused.status, 1);
        EXPECT_NE(refused.err.find(message), std::string::npos) << refused.err;
        const auto at_once = test::run_program(folder, "respond x.csv --population 'grid 2x2'");
        EXPECT_EQ(at_once.status, 1);
        EXPECT_NE(at_once.err.find(message), std::string::npos) << at_once.err;
    }
    folder.write("x.csv", "time_s,fz_N,fz_N\n0,0,0\n0.001,1,2\n0.002,1,2\n");
    EXPECT_EQ(test::run_program(folder, "stream --in x.csv --population sa1 --pace fast -q").status, 0) << "the names are fz and fz (2)";
}

// --- settings

TEST(StreamProgram, ParametersOfTheClassesOfAPopulationCanBeSet) {
    const TemporaryFolder folder;
    const auto recording = folder.write("touch.csv", noisy_recording(2000, 4));
    const auto spikes = [&](const std::string& settings) {
        const auto ran = test::run_program(folder, "stream --population 'grid 2x2' --in " + recording + " --rate 1kHz --pace fast" +
                                                       settings + " --json -o " + (folder / "spikes.csv"));
        EXPECT_EQ(ran.status, 0) << ran.err;
        return nlohmann::json::parse(ran.out)["spikes"].get<long>();
    };
    EXPECT_GT(spikes(" --set sa1.V_th=300mV"), spikes(" --set sa1.V_th=1V"));
    const auto wrong = test::run_program(folder, "stream --population 'grid 2x2' --rate 1kHz --set sa1.nothing=1 </dev/null");
    EXPECT_NE(wrong.status, 0);
    EXPECT_NE(wrong.err.find("unknown parameter 'nothing'"), std::string::npos) << wrong.err;
}

// --- senders on a network

TEST(StreamProgram, AllFramesSentBeforeAnInterruptAreProcessedEvenIfStillInTheSocket) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder, with_base_options({"--in", "tcp:0", "--json", "-o", folder / "s.csv"}));
    const int fd = connect_to(child.port());
    std::string frames;
    for (int k = 0; k < 300'000; ++k) frames += "2\n";
    for (std::string_view rest = frames; !rest.empty();) {
        const auto count = ::send(fd, rest.data(), rest.size(), MSG_NOSIGNAL);
        ASSERT_GT(count, 0);
        rest.remove_prefix(static_cast<std::size_t>(count));
    }
    ::close(fd);
    child.interrupt();
    const auto doc = nlohmann::json::parse(child.read_out());
    EXPECT_EQ(child.wait(), 130) << child.error_text();
    EXPECT_EQ(doc["frames"], 300'000);
    EXPECT_EQ(doc["input"]["bytes_unread"], 0);
}

TEST(StreamProgram, AnIdleSenderIsReplacedWhenAnotherConnects) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder,
                with_base_options({"--in", "tcp:0", "--idle-timeout", "300ms", "--clients", "2", "--json", "-o", folder / "s.csv"}));
    const int port = child.port(), silent = connect_to(port);
    EXPECT_EQ(::send(silent, "1\n", 2, MSG_NOSIGNAL), 2);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    EXPECT_EQ(::send(silent, "1\n", 2, MSG_NOSIGNAL), 2) << "no other sender waits";
    const int next = connect_to(port);
    EXPECT_EQ(::send(next, "1\n1\n", 4, MSG_NOSIGNAL), 4);
    ::close(next);
    const auto doc = nlohmann::json::parse(child.read_out());
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_EQ(doc["frames"], 4);
    EXPECT_EQ(doc["input"]["idle_senders"], 1);
    ::close(silent);
}

TEST(Network, ALostPeerIsDetectedWithinSecondsNotHours) {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    enable_keepalive(fd);
    const auto option = [fd](int level, int name) {
        int value = 0;
        socklen_t size = sizeof value;
        EXPECT_EQ(::getsockopt(fd, level, name, &value, &size), 0);
        return value;
    };
    EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 1);
    EXPECT_LE(option(IPPROTO_TCP, TCP_KEEPIDLE) + option(IPPROTO_TCP, TCP_KEEPINTVL) * option(IPPROTO_TCP, TCP_KEEPCNT), 20);
    ::close(fd);
}

int datagrams_to(int port) {
    const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const auto at = loopback_address(port);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
    return fd;
}

void send_datagram(int fd, std::string_view text) { EXPECT_EQ(::send(fd, text.data(), text.size(), 0), static_cast<ssize_t>(text.size())); }

TEST(StreamProgram, FramesInDatagramsGiveTheSpikesOfFramesInAPipe) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child by_pipe(folder, with_base_options({"--quiet"}));
    by_pipe.send(force_lines(600)), by_pipe.close_in();
    const auto expected = by_pipe.read_out();
    EXPECT_EQ(by_pipe.wait(), 0);
    EXPECT_GT(expected.size(), 200U);
    Child child(folder, with_base_options({"--in", "udp:0", "--clients", "1"}));
    const int fd = datagrams_to(child.port());
    for (int k = 0; k < 600; k += 3) {
        const auto lines = force_lines(3, k);
        send_datagram(fd, k % 2 == 0 ? lines : lines.substr(0, lines.size() - 1));  // the last line of a datagram needs no line feed
        if (k % 60 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    send_datagram(fd, "");  // marks the end
    EXPECT_EQ(child.read_out(), expected);
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_NE(child.error_text().find("600 frames (600 ms of force)"), std::string::npos) << child.error_text();
    ::close(fd);
}

TEST(StreamProgram, NumberedDatagramsKeepTheirTimeAndOneSenderIsAcceptedAtATime) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    Child child(folder, with_base_options({"--in", "udp:0", "--clients", "1", "--stamp", "sequence", "--frames", "f64", "--json", "-o",
                                           folder / "s.csv"}));
    const int port = child.port(), fd = datagrams_to(port), other_sender = datagrams_to(port);
    const auto frame = [](std::uint32_t number, double force) {
        std::string bytes(12, '\0');
        std::memcpy(bytes.data(), &number, 4), std::memcpy(bytes.data() + 4, &force, 8);
        return bytes;
    };
    send_datagram(fd, frame(0, 1));
    send_datagram(other_sender, frame(1, 1));
    send_datagram(fd, frame(4, 1) + frame(5, 1));
    send_datagram(fd, frame(3, 1));                        // late
    send_datagram(fd, frame(5, 1));                        // duplicate
    send_datagram(fd, frame(6, 1).substr(0, 11));          // an incomplete frame
    send_datagram(fd, frame(7, 1) + std::string(3, 'x'));  // a frame and three more bytes
    send_datagram(fd, "");
    const auto doc = nlohmann::json::parse(child.read_out());
    EXPECT_EQ(child.wait(), 0) << child.error_text();
    EXPECT_EQ(doc["frames"], 3);
    EXPECT_EQ(doc["frames_filled"], 3);
    EXPECT_EQ(doc["sequence"]["gaps"], 1);
    EXPECT_EQ(doc["sequence"]["late"], 1);
    EXPECT_EQ(doc["sequence"]["duplicates"], 1);
    EXPECT_EQ(doc["input"]["unreadable"], 2);
    EXPECT_EQ(doc["input"]["datagrams_ignored"], 1);
    EXPECT_NE(child.error_text().find("a datagram has 11 bytes"), std::string::npos) << child.error_text();
    ::close(fd), ::close(other_sender);
}

// --- signals, and options that are refused

TEST(StreamProgram, OneSignalEndsTheStreamWhileItWaitsForARecording) {
    ignore_broken_pipes();
    const TemporaryFolder folder;
    const auto fifo = folder / "fifo.csv";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    Child opening(folder, {"--in", fifo, "--rate", "1kHz"});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    opening.interrupt();
    EXPECT_EQ(opening.wait(), 130) << opening.error_text();
    Child reading(folder, {"--in", fifo, "--rate", "1kHz"});
    const int writer = ::open(fifo.c_str(), O_WRONLY | O_CLOEXEC);
    EXPECT_EQ(::write(writer, "f_N\n1\n", 6), 6);
    int unread = 1;
    for (int k = 0; k < 2000 && unread > 0; ++k) {
        ::ioctl(writer, FIONREAD, &unread);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(unread, 0) << "it reads the available samples";
    reading.interrupt();
    EXPECT_EQ(reading.wait(), 130) << reading.error_text();
    ::close(writer);
}

TEST(StreamProgram, ContradictoryOptionsAreRefused) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"", "--rate is required"},
        {"--rate 1kHz --format aerr", "unknown event format 'aerr'; did you mean 'aer'?"},
        {"--rate 1kHz --in tcp:99999", "write tcp:PORT"},
        {"--rate 1kHz --in udp:x", "write udp:PORT"},
        {"--rate 1kHz --in udp:0 --channels 20000 --frames f64", "a frame of 160000 bytes exceeds the maximum datagram"},
        {"--rate 1kHz --despike auto", "--despike is for recordings (--in FILE), not for live frames from standard input"},
        {"--rate 1kHz --time-unit ms", "--stamp time"},
        {"--in press --notch 50Hz", "--notch is for recordings, but press is a stimulus"},
        {"--in pres --pace fast", "did you mean 'press'?"},
        {"--rate 1kHz --unit mmHg", "use --scale S"},
        {"--rate 1kHz --set sa9.f_B=25Hz", "did you mean 'sa1'?"},
        {"--rate 1kHz --in serial:/dev/null", "this is not a serial device"},
        {"--rate 1kHz --to 7000 -o x.csv", "--out and --to cannot be used together"},
        {"--rate 1kHz --json", "--json prints on standard output"},
        {"--rate 1kHz --set sa1.nothing=1", "nothing"},
        {"--rate 1kHz --population 'grid 0x3'", "grid"},
        {"--in tcp:0 --rate 1kHz --listen 203.0.113.1", "cannot listen on 203.0.113.1:0"},
    };
    for (const auto& [options, message] : cases) {
        const auto ran = test::run_program(folder, std::string("stream ") + options + " </dev/null");
        EXPECT_NE(ran.status, 0) << options;
        EXPECT_NE(ran.err.find(message), std::string::npos) << options << ": " << ran.err;
    }
}

}  // namespace
}  // namespace corpuscle
