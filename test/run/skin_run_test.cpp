// Runs of a skin as users start them: stopped and resumed, on MPI ranks, with a recording of many channels. The bytes are always the same.

#include <fmt/format.h>
#include <unistd.h>
#include <cstring>

#include "core/stimulus/stimuli.hpp"
#include "io/spikes/events.hpp"
#include "io/table/npz.hpp"
#include "run/skin/skin_simulator.hpp"
#include "support/program.hpp"
#include "support/sinks.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::read_file, test::value_or_throw;

/// Simulates a press on a fingertip and writes the events to `out`; stops after `blocks` blocks (-1: does not stop).
Result<RunStats> press_fingertip(const TemporaryFolder& folder, const std::string& out, int blocks, bool with_checkpoint,
                                 const RunFingerprint& fingerprint = {{"FORCE", "press"}}, double scale = 1) {
    static const auto skin = value_or_throw(innervate(value_or_throw(load_skin_plan("fingertip"))));
    const auto source =
        test::applied_or_throw(make_stimulus("press", test::parse_settings({"press.F_max=" + std::to_string(4 * scale)}), 1e3, 0));
    const auto contact = test::applied_or_throw(make_contact("sphere", {}, skin->plan.sites, source->clock()));
    const auto force = make_pressed_force(*source, *contact);
    const auto running = value_or_throw(Skin::make(skin, {1e-3}, *instruction_set()));
    std::unique_ptr<SkinCheckpoint> checkpoint;
    if (with_checkpoint) {
        auto opened = SkinCheckpoint::open(folder / "state", *running, fingerprint);
        if (!opened) return opened.error();
        checkpoint = std::move(*opened);
    }
    const auto file = test::make_sink(events_format, folder / out, {.options = {{"--events", "aer"}}});
    Sink* const sinks[] = {file.get()};
    SkinPopulation population(*skin);
    std::vector<std::unique_ptr<BlockSimulator>> inputs;
    inputs.push_back(
        std::make_unique<SkinSimulator>(population, make_input(population, "press", *source), *force, *running, checkpoint.get()));
    auto done = run(std::move(inputs), sinks, {.should_continue = [&](double) { return blocks-- != 0; }});
    if (done && file->commit() && checkpoint) checkpoint->remove_files();
    return done;
}

TEST(SkinRun, StoppedRepeatedlyItResumesToTheSameBytes) {
    const TemporaryFolder folder;
    const auto uninterrupted_run = value_or_throw(press_fingertip(folder, "whole", -1, false));
    ASSERT_GT(uninterrupted_run.spikes, 500);
    for (int stops = 0; stops < 20; ++stops) {
        const auto done = press_fingertip(folder, "parts", 2 + 2 * stops, true);  // blocks, including those that are run again
        if (done) {
            EXPECT_GT(stops, 3);
            EXPECT_EQ(done->spikes, uninterrupted_run.spikes);
            EXPECT_EQ(done->skipped_steps, uninterrupted_run.skipped_steps);
            break;
        }
        ASSERT_EQ(done.error().code, ErrorCode::interrupted);
        EXPECT_FALSE(std::filesystem::exists(folder / "parts"));
    }
    EXPECT_EQ(read_file(folder / "parts/spikes.aer"), read_file(folder / "whole/spikes.aer"));
    EXPECT_FALSE(std::filesystem::exists(folder / "state")) << "the checkpoint of a complete run is removed";
    EXPECT_FALSE(std::filesystem::exists(folder / "state.spikes"));
}

TEST(SkinRun, ACheckpointOfAnotherRunIsRefusedWithTheDifferencesAndNotChanged) {
    const TemporaryFolder folder;
    const RunFingerprint then = {{"FORCE", "touch.csv"}, {"--scale", "1"}, {"--abs", "true"}, {"contents of the recording", "a"}},
                         now = {{"FORCE", "touch.csv"}, {"--scale", "3"}, {"--despike", "auto"}, {"contents of the recording", "b"}};
    ASSERT_FALSE(press_fingertip(folder, "a", 5, true, then));
    const auto stored = read_file(folder / "state"), spikes = read_file(folder / "state.spikes");
    const auto other = press_fingertip(folder, "a", 5, true, now);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::bad_input);
    EXPECT_NE(other.error().message.find(
                  "--scale was 1 and now is 3; --abs was true and now is not given; the contents of the recording "
                  "have changed; --despike was not given and now is auto. Repeat the run with its original options, remove "),
              std::string::npos)
        << other.error().message;
    EXPECT_EQ(read_file(folder / "state"), stored);
    EXPECT_EQ(read_file(folder / "state.spikes"), spikes);
}

TEST(SkinRun, ACheckpointOfAnotherForceIsRefusedEvenWithTheSameOptions) {
    const TemporaryFolder folder;
    ASSERT_FALSE(press_fingertip(folder, "a", 5, true));
    const auto other = press_fingertip(folder, "a", -1, true, {{"FORCE", "press"}}, 1.5);
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().message.find("the force before this checkpoint differs from the force of the run that wrote it"),
              std::string::npos)
        << other.error().message;
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

TEST(SkinRun, ACheckpointThatIsCutShortOrHasAFlippedBitIsRefused) {
    const TemporaryFolder folder;
    ASSERT_FALSE(press_fingertip(folder, "a", 5, true));
    const auto stored = read_file(folder / "state"), spikes = read_file(folder / "state.spikes");
    ASSERT_GT(spikes.size(), 100U * 24);
    const auto refused = [&](const std::string& what) {
        const auto done = press_fingertip(folder, "a", 0, true);
        EXPECT_FALSE(done) << what;
        EXPECT_EQ(done.error().code, ErrorCode::bad_input) << what << done.error().message;
        EXPECT_NE(done.error().message.find("--checkpoint"), std::string::npos) << done.error().message;
    };
    for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{30}, stored.size() / 2, stored.size() - 1}) {
        folder.write("state", stored.substr(0, size));
        refused("FILE cut to " + std::to_string(size));
    }
    for (std::size_t at = 0; at < stored.size(); at += 1 + stored.size() / 60) {
        auto damaged = stored;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
        folder.write("state", damaged);
        refused("FILE, byte " + std::to_string(at));
    }
    folder.write("state", stored);
    for (std::size_t at = 0; at < spikes.size(); at += 1 + spikes.size() / 60) {
        auto damaged = spikes;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
        folder.write("state.spikes", damaged);
        refused("FILE.spikes, byte " + std::to_string(at));
        EXPECT_EQ(read_file(folder / "state.spikes"), damaged) << "a refused file is not changed";
    }
    folder.write("state.spikes", spikes.substr(0, spikes.size() / 2));
    refused("FILE.spikes cut to a half");
    std::filesystem::remove(folder / "state.spikes");
    refused("FILE.spikes removed");
    folder.write("state.spikes", spikes);
    EXPECT_EQ(press_fingertip(folder, "a", 0, true).error().code, ErrorCode::interrupted) << "the complete checkpoint is resumed";
}

/// The position of the number of spikes in FILE, bytes: after the magic bytes, one pair of texts, and the checksum of the force.
constexpr std::size_t count_at = 23 + 8 + (8 + 5) + (8 + 5) + 8;

TEST(SkinRun, ACheckpointThatCountsTooManySpikesIsRefusedAndNotTruncated) {
    const TemporaryFolder folder;
    ASSERT_FALSE(press_fingertip(folder, "a", 5, true));
    const auto stored = read_file(folder / "state"), spikes = read_file(folder / "state.spikes");
    std::uint64_t count = 0;
    std::memcpy(&count, stored.data() + count_at, sizeof count);
    ASSERT_EQ(24 + 24 * count, spikes.size());
    for (const auto claimed : {count + 1, std::uint64_t{1} << 61, (std::uint64_t{1} << 61) + count, ~std::uint64_t{0}}) {
        auto more = stored.substr(0, stored.size() - sizeof count);
        std::memcpy(more.data() + count_at, &claimed, sizeof claimed);
        const auto sum = checksum_of(std::as_bytes(std::span(more)));
        more.append(reinterpret_cast<const char*>(&sum), sizeof sum);
        folder.write("state", more);
        const auto done = press_fingertip(folder, "a", -1, true);
        ASSERT_FALSE(done) << claimed;
        EXPECT_NE(done.error().message.find("it has "), std::string::npos) << done.error().message;
        EXPECT_EQ(read_file(folder / "state.spikes"), spikes);
    }
}

TEST(SkinRun, ACheckpointOfAnEarlierVersionIsRefusedWithItsVersionAndARemedy) {
    const TemporaryFolder folder;
    folder.write("state", std::string("corpuscle checkpoint 1\n") + std::string(200, '\0')), folder.write("state.spikes", "");
    const auto done = press_fingertip(folder, "a", 5, true);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("a checkpoint of version 1;"), std::string::npos) << done.error().message;
    EXPECT_NE(done.error().message.find("remove " + folder / "state"), std::string::npos) << done.error().message;
}

TEST(SkinRun, TwoRunsCannotShareACheckpoint) {
    const TemporaryFolder folder;
    const auto innervation = value_or_throw(innervate(value_or_throw(load_skin_plan("grid 2x2"))));
    const auto one = value_or_throw(Skin::make(innervation, {1e-3}, *instruction_set())),
               two = value_or_throw(Skin::make(innervation, {1e-3}, *instruction_set()));
    auto first = value_or_throw(SkinCheckpoint::open(folder / "state", *one, {}));
    const auto second = SkinCheckpoint::open(folder / "state", *two, {});
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("another run is using this checkpoint"), std::string::npos) << second.error().message;
    first->remove_files();
    EXPECT_TRUE(SkinCheckpoint::open(folder / "state", *two, {}));
}

TEST(SkinRun, FilesThatNoCheckpointWroteAreNeitherEmptiedNorRemoved) {
    const TemporaryFolder folder;
    for (const std::string text : {"1.5 sorted by hand\n", ""}) {
        folder.write("mine.spikes", text);
        const auto ran = test::run_program(folder, "respond press --population fingertip --checkpoint mine");
        EXPECT_EQ(ran.status, 1);
        EXPECT_NE(ran.err.find("mine.spikes: this file was not written by a checkpoint"), std::string::npos) << ran.err;
        EXPECT_EQ(read_file(folder / "mine.spikes"), text);
        EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"mine.spikes"}));
    }
    folder.write("own", "a text\n");
    for (const char* overwrite : {"", "--overwrite"}) {
        const auto ran = test::run_program(folder, std::string("respond press --population fingertip --checkpoint own ") + overwrite);
        EXPECT_EQ(ran.status, 1);
        EXPECT_NE(ran.err.find("own"), std::string::npos) << ran.err;
        EXPECT_EQ(read_file(folder / "own"), "a text\n");
        EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"mine.spikes", "own"}));
    }
    if (test::run_program(folder, "respond press --population fingertip --checkpoint spikes.csv --out . --quiet").status == 0) {
        EXPECT_TRUE(std::filesystem::exists(folder / "spikes.csv")) << "an output with the checkpoint's name is kept";
    }
}

TEST(SkinRun, ARunThatFailsBeforeItsFirstCheckpointLeavesNothingBehind) {
    const TemporaryFolder folder;
    folder.write("touch.csv", "time_s,f_N\n0,1\n0.001,1\n0.002,1\n0.003,here\n");
    EXPECT_EQ(test::run_program(folder, "respond touch.csv --population fingertip --rate 1kHz --checkpoint kept --out out").status, 1);
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"touch.csv"}));
}

TEST(SkinRun, ResumingWithAnotherScaleOrOtherContentsIsRefused) {
    const TemporaryFolder folder;
    const auto recording = [&](double force) {
        std::string text = "time_s,f_N\n";
        for (int k = 0; k < 60'000; ++k) text += fmt::format("{:.3f},{}\n", k / 1000.0, k / 500 % 2 * force);
        return text;
    };
    folder.write("touch.csv", recording(1));
    const std::string arguments = "respond touch.csv --population fingertip --scale 2 --checkpoint kept --out out";
    for (const char* seconds : {"0.4", "1", "3", "8", "20"}) {  // on a busy machine it may not have started yet
        const auto command =
            "cd '" + folder.path() + "' && timeout -s INT " + seconds + " '" + test::program_path() + "' " + arguments + " -j 1 2>log >&2";
        const int status = WEXITSTATUS(std::system(command.c_str()));
        if (status == 0) GTEST_SKIP() << "it ended before it could be interrupted";
        if (std::filesystem::exists(folder / "kept")) break;
    }
    ASSERT_TRUE(std::filesystem::exists(folder / "kept")) << read_file(folder / "log");
    const auto scaled = test::run_program(folder, "respond touch.csv --population fingertip --scale 3 --checkpoint kept --out out");
    EXPECT_EQ(scaled.status, 1);
    EXPECT_NE(scaled.err.find("--scale was 2 and now is 3"), std::string::npos) << scaled.err;
    folder.write("touch.csv", recording(1.001));
    const auto other = test::run_program(folder, arguments);
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("the contents of the recording have changed"), std::string::npos) << other.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(SkinRun, ChannelsOfARecordingAreAssignedToSitesByNameOrInOrder) {
    const TemporaryFolder folder;
    std::string named = "time_s,r2c1_N,r1c1_N\n", in_order = "time_s,a_N,b_N,c_N,d_N\n";
    for (int k = 0; k < 600; ++k) {
        const auto force = std::to_string(std::min(4.0, 0.05 * k)), time = std::to_string(k / 1000.0);
        named += time + "," + force + ",0\n";
        in_order += time + ",0,0," + force + ",0\n";
    }
    folder.write("named.csv", named), folder.write("ordered.csv", in_order);
    ASSERT_EQ(test::run_program(folder, "respond named.csv --population 'grid 2x2' --out named --quiet").status, 0);
    ASSERT_EQ(test::run_program(folder, "respond ordered.csv --population 'grid 2x2' --out ordered --quiet").status, 0);
    EXPECT_EQ(read_file(folder / "named/spikes.csv"), read_file(folder / "ordered/spikes.csv"));
    EXPECT_NE(read_file(folder / "named/afferents.csv").find("sa1#3"), std::string::npos);
    const auto wrong = test::run_program(folder, "respond ordered.csv --population 'grid 3x2' --out wrong");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("ordered has 4 channels, but grid 3x2 has 6 sites"), std::string::npos) << wrong.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "wrong"));
}

TEST(SkinRun, SpikesOfASkinAreWrittenAsNumPyArraysToo) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::run_program(folder, "respond press --population fingertip --npz --out a --quiet").status, 0);
    const auto npz = value_or_throw(NpzReader::open(folder / "a/spikes.npz"));
    const auto labels = value_or_throw(npz.integers("spike_labels_seg0")), indexes = value_or_throw(npz.integers("spike_indexes_seg0"));
    const auto times = value_or_throw(npz.numbers("spike_times_seg0"));
    const auto names = value_or_throw(npz.strings("unit_afferent")), regions = value_or_throw(npz.strings("unit_channel"));
    std::string text = "afferent,channel,time_s\n";
    for (std::size_t k = 0; k < times.size(); ++k) {
        const auto afferent = static_cast<std::size_t>(labels[k]);
        text += fmt::format("{},{},{:.9f}\n", names[afferent], regions[afferent], times[k]);
        EXPECT_NEAR(static_cast<double>(indexes[k]) * 1e-6, times[k], 0.5000001e-6);
    }
    EXPECT_EQ(text, read_file(folder / "a/spikes.csv"));
    EXPECT_EQ(value_or_throw(npz.numbers("unit_x_m")).size(), names.size());
    EXPECT_EQ(test::run_program(folder, "compare a/spikes.csv a/spikes.npz").status, 0);
    EXPECT_NE(test::run_program(folder, "respond press --population fingertip --npz").err.find("--npz needs --out DIR"), std::string::npos);
}

TEST(SkinRun, OptionsForAfferentsOnChannelsAreRefused) {
    const TemporaryFolder folder;
    for (const char* arguments :
         {"--afferent fa2", "--afferent nothing", "--copies 3", "--noise 10nA", "--vectors --out x", "--corner ss"}) {
        const auto ran = test::run_program(folder, std::string("respond press --population fingertip ") + arguments);
        EXPECT_EQ(ran.status, 2) << arguments << ran.err;
        EXPECT_NE(ran.err.find("cannot be used with --population"), std::string::npos) << ran.err;
    }
    EXPECT_EQ(test::run_program(folder, "respond press --population fingertip --set sa1.f_X=2Hz").status, 1);
    EXPECT_EQ(test::run_program(folder, "respond press --population fingertip --set sa9.f_B=2Hz").status, 2);
}

TEST(SkinRanks, GiveTheSpikesOfOneProcess) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::run_program(folder, "respond press --population fingertip --events aer --out alone --quiet").status, 0);
    const std::string root = ::geteuid() == 0 ? "--allow-run-as-root " : "";
    const auto ranks = [&](int count, const std::string& arguments) {
        const auto command = "cd '" + folder.path() + "' && timeout 60 mpirun " + root + "--oversubscribe -n " + std::to_string(count) +
                             " '" + test::program_path() + "' respond " + arguments + " --quiet >log 2>&1";
        return WEXITSTATUS(std::system(command.c_str()));
    };
    for (const int count : {2, 3}) {
        ASSERT_EQ(ranks(count, "press --population fingertip --events aer --out r"), 0) << read_file(folder / "log");
        for (const char* file : {"spikes.aer", "afferents.csv", "summary.json"})
            EXPECT_EQ(read_file((folder / "r/") + file), read_file((folder / "alone/") + file)) << file << " of " << count;
    }
    EXPECT_EQ(ranks(2, "press --population fingertip --set press.F_max=no"), 1);
    EXPECT_NE(read_file(folder / "log").find("F_max"), std::string::npos);
    EXPECT_EQ(ranks(2, "press --population fingertip --noise 1nA"), 2);
    const auto log = read_file(folder / "log");
    EXPECT_NE(log.find("--noise cannot be used"), std::string::npos);
    EXPECT_EQ(log.find("--noise cannot be used"), log.rfind("--noise cannot be used")) << "printed by one process only";
}

}  // namespace
}  // namespace corpuscle
