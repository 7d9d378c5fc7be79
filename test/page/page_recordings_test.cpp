// Recordings that the engine keeps, and their refusals.

#include <fmt/format.h>
#include <algorithm>

#include "page/replay.hpp"

namespace corpuscle::page {
namespace {

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
