// Recordings that the engine keeps: their clock, and the same warnings as those of the program.

#include <fmt/format.h>
#include <algorithm>

#include "core/random.hpp"
#include "page/ask.hpp"
#include "support/program.hpp"

namespace corpuscle::page {
namespace {

using test::run_program, test::TemporaryFolder;

std::vector<std::uint8_t> file_of(const std::string& text) { return {text.begin(), text.end()}; }

/// A CSV recording in N with this force at each sample.
template <class Force>
std::string recording(std::size_t samples, double rate, double t0, Force force) {
    std::string text = "time_s,force_N\n";
    for (std::size_t k = 0; k < samples; ++k) text += fmt::format("{:.6f},{:.6f}\n", t0 + static_cast<double>(k) / rate, force(k));
    return text;
}

double noise_at(std::size_t k) { return 5e-3 * normal_pair(3, static_cast<std::uint32_t>(k), 1, 0).first; }

/// The answers to `read` and `respond` for a recording.
struct Replay {
    PageAnswer read, respond;

    static Replay of(const std::string& name, const std::string& text, const std::string& rows) {
        PageEngine engine;
        auto read = ask(engine, fmt::format(R"({{"request": "read", "name": "{}", "keep": true}})", name), "file", file_of(text));
        EXPECT_EQ(read.error(), "");
        return {std::move(read), ask_well(engine, fmt::format(R"({{"request": "respond", "channel": 0, "rows": [{}]}})", rows))};
    }
    std::string warnings() const {
        std::string out;
        for (const auto& warning : respond["warnings"]) out += warning.get<std::string>() + "\n";
        return out;
    }
};

/// Each warning of a replay is one that the program prints.
void expect_printed(const Replay& replay, const std::string& printed) {
    for (const auto& warning : replay.respond["warnings"])
        EXPECT_NE(printed.find(warning.get<std::string>()), std::string::npos) << warning << "\n" << printed;
}

TEST(PageRecordings, AReplayWarnsOfTheNoiseOfTheSensorAsTheProgramDoes) {
    const TemporaryFolder folder;
    const auto text = recording(3000, 1000, 0, noise_at);
    folder.write("rest.csv", text);
    const auto replay = Replay::of("rest.csv", text, R"({"afferent": "sa1"}, {"afferent": "fa1-nerve"})");
    EXPECT_NE(replay.warnings().find("the noise of the sensor, about "), std::string::npos) << replay.warnings();
    EXPECT_NE(replay.warnings().find("make fa1-nerve fire. Use --zero 500ms --deadband auto"), std::string::npos) << replay.warnings();
    expect_printed(replay, run_program(folder, "respond rest.csv --afferent sa1,fa1-nerve").err);
}

TEST(PageRecordings, TheNoiseIsThatOfTheChosenChannel) {
    std::string text = "time_s,quiet_N,noisy_N\n";
    for (std::size_t k = 0; k < 3000; ++k) text += fmt::format("{:.3f},0,{:.6f}\n", static_cast<double>(k) / 1000, noise_at(k));
    PageEngine engine;
    ask(engine, R"({"request": "read", "name": "two.csv", "keep": true})", "file", file_of(text));
    const auto warnings = [&](int channel) {
        return ask_well(
            engine, fmt::format(R"({{"request": "respond", "channel": {}, "rows": [{{"afferent": "fa1-nerve"}}]}})", channel))["warnings"];
    };
    EXPECT_EQ(warnings(0).size(), 0U) << warnings(0);
    ASSERT_EQ(warnings(1).size(), 1U) << warnings(1);
    EXPECT_NE(warnings(1)[0].get<std::string>().find("on 'noisy', is enough"), std::string::npos) << warnings(1);
}

TEST(PageRecordings, AReplayWarnsOfTruncatedStepsAndUnresolvedRatesAsTheProgramDoes) {
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

TEST(PageRecordings, AResponseHasTheSamplesOutsideEachRange) {
    PageEngine engine;
    const std::vector<double> force(500, 15.0);
    const auto answer =
        ask(engine, R"({"request": "respond", "rate": 1000, "rows": [{"afferent": "sa1-circuit"}, {"afferent": "sa1"}]})", "force", force);
    ASSERT_EQ(answer.error(), "");
    const auto& row = answer["rows"][0];
    ASSERT_EQ(row["outside"].size(), row["ranges"].size());
    std::int64_t most = 0;
    for (const auto& samples : row["outside"]) most = std::max(most, samples.get<std::int64_t>());
    EXPECT_GT(most, 100);
    EXPECT_EQ(answer["rows"][1]["outside"].size(), 0U);
    ASSERT_EQ(answer["warnings"].size(), 1U);
    EXPECT_TRUE(answer["warnings"][0].get<std::string>().starts_with("sa1-circuit on force: v(vf) was outside ")) << answer["warnings"];

    const auto chips = ask(engine, R"({"request": "monte-carlo", "afferent": "sa1-circuit", "chips": 2, "rate": 1000})", "force", force);
    ASSERT_EQ(chips.error(), "");
    for (const auto& chip : chips["rows"]) EXPECT_EQ(chip["outside"].size(), chips["ranges"].size());
    EXPECT_EQ(chips["ranges"], row["ranges"]);
}

TEST(PageRecordings, AReplayHasTheTimesOfTheRecording) {
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

TEST(PageRecordings, AKeptRecordingGivesTheSpikesOfItsForce) {
    PageEngine engine;
    const auto text = recording(1000, 1000, 0, [](std::size_t k) { return k > 200 ? 2.0 : 0.0; });
    const auto sent = ask(engine, R"({"request": "read", "name": "step.csv"})", "file", file_of(text));
    const auto of_array =
        ask(engine, R"({"request": "respond", "rate": 1000, "rows": [{"afferent": "sa1"}]})", "force", sent.numbers("force.0"));
    const auto kept = ask(engine, R"({"request": "read", "name": "step.csv", "keep": true})", "file", file_of(text));
    EXPECT_EQ(kept["samples"], 1000);
    EXPECT_FALSE(kept.has("force.0")) << "the force stays in the engine";
    const auto of_channel = ask_well(engine, R"({"request": "respond", "channel": 0, "rows": [{"afferent": "sa1"}]})");
    EXPECT_GT(of_channel.numbers("time").size(), 3U);
    EXPECT_EQ(of_channel.numbers("time"), of_array.numbers("time"));
    EXPECT_EQ(ask(engine, R"({"request": "respond", "channel": 1, "rows": [{"afferent": "sa1"}]})").error(),
              "respond: \"channel\" is 1; expected an integer from 0 to 0");
    EXPECT_EQ(ask(engine, R"({"request": "respond", "channel": 0, "rate": 10, "rows": [{"afferent": "sa1"}]})").error(),
              "respond: give either \"channel\", of the recording, or \"rate\"");
    EXPECT_NE(ask(engine, R"({"request": "read", "name": "x.csv", "keep": true})", "file", file_of("x\ny\n")).error(), "");
    EXPECT_EQ(ask(engine, R"({"request": "respond", "channel": 0, "rows": [{"afferent": "sa1"}]})").error(),
              "respond: there is no recording for \"channel\"; send the request \"read\" with \"keep\": true first");
}

TEST(PageRecordings, AKeptRecordingIsForgottenBeforeOptionsAreRead) {
    PageEngine engine;
    ask(engine, R"({"request": "read", "name": "step.csv", "keep": true})", "file", file_of("t,F\n0,0\n0.001,1\n"));
    const auto refused =
        ask(engine, R"({"request": "read", "name": "b.csv", "options": {"lowpas": "1Hz"}, "keep": true})", "file", file_of("1\n"));
    EXPECT_NE(refused.error().find("lowpas"), std::string::npos);
    EXPECT_NE(ask(engine, R"({"request": "respond", "channel": 0, "rows": [{"afferent": "sa1"}]})").error().find("there is no recording"),
              std::string::npos);
}

TEST(PageRecordings, ErrorsDoNotNameTheTemporaryDirectory) {
    PageEngine engine;
    for (const std::string name : {"annas.csv", "anna's.csv", "two words.csv"}) {
        const auto text =
            ask(engine, fmt::format(R"({{"request": "read", "name": "{}"}})", name), "file", file_of("\x89HDF\r\n\x1a\n more")).error();
        EXPECT_NE(text, "");
        EXPECT_EQ(text.find("corpuscle-page-"), std::string::npos) << text;
    }
}

TEST(PageRecordings, ANetlistIsNoRecording) {
    PageEngine engine;
    const auto netlist = file_of("Axon-Hillock after Mead\nVdd vdd 0 3.3\n.end\n");
    EXPECT_EQ(
        ask(engine, R"({"request": "read", "name": "own.cir"})", "file", netlist).error(),
        "own.cir: this is a netlist, not a recording; the page has built-in circuits and equations only; type: corpuscle respond press "
        "--afferent own.cir");
    EXPECT_NE(ask(engine, R"({"request": "read", "name": "my own.CIR"})", "file", netlist).error().find("--afferent 'my own.CIR'"),
              std::string::npos);
}

TEST(PageRecordings, ARecordingWithTooManyValuesSaysTheLimitAndTheCommand) {
    PageEngine engine;
    const std::string header = "{'descr': '|i1', 'fortran_order': False, 'shape': (51000000, 1), }";
    std::string npy =
        std::string("\x93NUMPY\x01\x00", 8) + std::string("\x76\x00", 2) + header + std::string(117 - header.size(), ' ') + "\n";
    npy.resize(npy.size() + 51'000'000);
    const auto answer =
        ask(engine, R"({"request": "read", "name": "big one.npy", "options": {"rate": "1kHz", "unit": "N"}})", "file", file_of(npy));
    EXPECT_EQ(
        answer.error(),
        "the recording has more than 50 million values, the samples of all its channels together, which is the limit of the page. Choose "
        "channels with --channel, or type: corpuscle respond 'big one.npy'");
}

}  // namespace
}  // namespace corpuscle::page
