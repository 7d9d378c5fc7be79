// Replays of the engine beside those of the program: the same warnings and times. Not among the reader tests, which do not have the
// program.

#include <algorithm>

#include "page/replay.hpp"
#include "support/program.hpp"

namespace corpuscle::page {
namespace {

using test::run_program, test::TemporaryFolder;

/// Each warning and each note of a replay is one that the program prints.
void expect_printed(const Replay& replay, const std::string& printed) {
    for (const char* kind : {"warnings", "notes"})
        for (const auto& text : replay.respond[kind])
            EXPECT_NE(printed.find(text.get<std::string>()), std::string::npos) << text << "\n" << printed;
}

TEST(ReplayProgram, AReplayWarnsOfTheNoiseOfTheSensorAsTheProgramDoes) {
    const TemporaryFolder folder;
    const auto text = recording(3000, 1000, 0, noise_at);
    folder.write("rest.csv", text);
    const auto replay = Replay::of("rest.csv", text, R"({"afferent": "sa1"}, {"afferent": "fa1-nerve"})");
    EXPECT_NE(replay.warnings().find("the noise of the sensor, about "), std::string::npos) << replay.warnings();
    EXPECT_NE(replay.warnings().find("make fa1-nerve fire. Use --zero 500ms --deadband auto"), std::string::npos) << replay.warnings();
    expect_printed(replay, run_program(folder, "respond rest.csv --afferent sa1,fa1-nerve").err);
}

TEST(ReplayProgram, AReplayWarnsOfTruncatedStepsAndUnresolvedRatesAsTheProgramDoes) {
    const TemporaryFolder folder;
    const auto text = recording(100, 100, 0, [](std::size_t k) { return k < 10 ? 0 : 1e5; });
    folder.write("strong.csv", text);
    const auto printed = run_program(folder, "respond strong.csv --afferent sa1,sa1-nerve").err;
    const auto replay = Replay::of("strong.csv", text, R"({"afferent": "sa1"}, {"afferent": "sa1-nerve"})");
    EXPECT_NE(replay.warnings().find("steps had more spikes than one step can hold"), std::string::npos) << replay.warnings();
    EXPECT_NE(replay.warnings().find("several spikes come within one sample"), std::string::npos) << replay.warnings();
    expect_printed(replay, printed);
    const auto count = [](const std::string& all, const std::string& part) {
        std::size_t out = 0;
        for (auto at = all.find(part); at != all.npos; at = all.find(part, at + 1)) ++out;
        return out;
    };
    for (const char* part : {"truncated", "several spikes"}) EXPECT_EQ(count(replay.warnings(), part), count(printed, part)) << part;
}

TEST(ReplayProgram, AReplayNamesAfferentsThatNeverFiredAsTheProgramDoes) {
    const TemporaryFolder folder;
    const auto text = recording(1000, 1000, 0, [](std::size_t k) { return k > 200 && k < 700 ? 2e-3 : 0.0; });
    folder.write("weak.csv", text);
    const auto replay = Replay::of("weak.csv", text, R"({"afferent": "sa1"}, {"afferent": "fa1"})");
    ASSERT_EQ(replay.respond["notes"].size(), 2U) << replay.respond["notes"];
    const auto note = replay.respond["notes"][0].get<std::string>();
    EXPECT_EQ(note.find("sa1 never fired: the largest force was 0.002 N; it would fire at about "), 0U) << note;
    EXPECT_NE(note.find("; try sa1-nerve"), std::string::npos) << note;
    expect_printed(replay, run_program(folder, "respond weak.csv --afferent sa1,fa1").err);
}

TEST(ReplayProgram, AReplayHasTheTimesOfTheRecording) {
    const TemporaryFolder folder;
    const auto text = recording(1000, 1000, 100, [](std::size_t k) { return k > 200 && k < 700 ? 2.0 : 0.0; });
    folder.write("late.csv", text);
    const auto replay = Replay::of("late.csv", text, R"({"afferent": "sa1-nerve"})");
    EXPECT_EQ(replay.read["t0"], 100.0);
    EXPECT_EQ(replay.respond["t0"], 100.0);
    EXPECT_EQ(replay.respond["rate"], 1000.0);
    EXPECT_EQ(replay.respond.numbers("force").size(), 1000U);
    ASSERT_EQ(run_program(folder, "respond late.csv --afferent sa1-nerve --out out").status, 0);
    std::string expected = "afferent,channel,time_s\n";
    for (const double t : replay.respond.numbers("time")) expected += fmt::format("sa1-nerve,force,{:.9f}\n", t);
    EXPECT_EQ(test::read_file(folder / "out/spikes.csv"), expected);
}

}  // namespace
}  // namespace corpuscle::page
