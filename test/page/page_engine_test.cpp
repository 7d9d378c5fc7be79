#include "page/page_engine.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <thread>

#include "core/stimulus/stimuli.hpp"
#include "page/ask.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"

namespace corpuscle::page {
namespace {

constexpr std::string_view press_request =
    R"({"request": "respond", "rate": 10000, "stimulus": "press", "rows": [{"afferent": "AFFERENT"}]})";

std::string request_for(std::string_view afferent) {
    std::string out(press_request);
    return out.replace(out.find("AFFERENT"), 8, afferent);
}

/// The spike times of an afferent under `press`, without the page.
std::vector<double> press_times(std::string_view afferent) {
    auto force = *read_channel(**make_stimulus("press", 1e4, 0));
    const auto plan = plan_any_afferent(afferent)->result;
    return spike_times(simulate(*make_afferent(plan, {.dt = 1e-4}), force)->spikes, *make_clock(1e4));
}

TEST(PageEngine, RespondsAsTheLibraryDoes) {
    PageEngine engine;
    for (const std::string_view afferent : {"sa1", "fa1", "sa1-nerve", "fa1-nerve", "sa1b+izhikevich", "sa1-circuit"}) {
        const auto answer = ask_well(engine, request_for(afferent));
        EXPECT_EQ(answer.numbers("time"), press_times(afferent)) << afferent;
        EXPECT_GT(answer.numbers("time").size(), 3U) << afferent;
        EXPECT_EQ(answer["done"], true);
    }
}

TEST(PageEngine, GivesTheSameSpikesForBlocksOfAnyLength) {
    PageEngine engine;
    const auto force = *read_channel(**make_stimulus("press", 1e4, 0));
    ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}, {"afferent": "sa1-circuit"}]})");
    std::vector<double> times[2];
    auto padded = force;
    padded.resize(padded.size() + 1000, 0.0);  // the circuit is late
    for (std::size_t at = 0, length = 1; at < padded.size(); at += length, length = length * 3 % 997 + 1) {
        length = std::min(length, padded.size() - at);
        const std::vector<double> part(padded.begin() + static_cast<std::ptrdiff_t>(at),
                                       padded.begin() + static_cast<std::ptrdiff_t>(at + length));
        const auto answer = ask(engine, fmt::format(R"({{"request": "advance", "samples": {}}})", length), "force", part);
        ASSERT_EQ(answer.error(), "");
        const auto found = answer.numbers("time");
        const auto units = answer.units();
        for (std::size_t k = 0; k < found.size(); ++k) times[units[k]].push_back(found[k]);
    }
    EXPECT_EQ(times[0], press_times("sa1"));
    EXPECT_EQ(times[1], press_times("sa1-circuit"));
}

TEST(PageEngine, PressesASkinWhereTheRequestSays) {
    PageEngine engine;
    const auto start = ask_well(engine, R"({"request": "start", "rate": 1000, "skin": {"population": "fingertip"}})");
    const auto x = start.numbers("x"), y = start.numbers("y");
    ASSERT_EQ(x.size(), start["units"].get<std::size_t>());
    const auto* classes = start.message.find("class");
    ASSERT_NE(classes, nullptr);
    EXPECT_EQ(start["skin"]["classes"][0]["name"].get<std::string>().substr(0, 3), "sa1");
    EXPECT_GT(start.numbers("outline.0").size(), 20U);
    EXPECT_EQ(start.numbers("outline.0").size() % 2, 0U);
    // Press near the left end, then near the right end: the afferents that respond are on that side.
    const double left = start["skin"]["left"], right = start["skin"]["right"], middle = start["skin"]["y"];
    for (const double side : {0.25, 0.75}) {
        const double at = left + side * (right - left);
        const auto answer =
            ask_well(engine, fmt::format(R"({{"request": "advance", "samples": 300, "force": 1, "x": {}, "y": {}}})", at, middle));
        const auto units = answer.units();
        ASSERT_GT(units.size(), 20U);
        double sum = 0, count = 0;  // of SA-I, whose receptive fields are small
        for (const auto u : units)
            if (classes->data[u] == std::byte{0}) sum += x[u], ++count;
        EXPECT_NEAR(sum / count, at, 0.15 * (right - left));
        EXPECT_GT(answer["contact"]["radius"].get<double>(), 0);
        ask_well(engine, R"({"request": "advance", "samples": 500, "force": 0})");
    }
}

TEST(PageEngine, ReturnsProbesAtTheRequestedSamples) {
    PageEngine engine;
    ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}, {"afferent": "sa1-circuit"}]})");
    const auto first = ask_well(engine, R"({"request": "advance", "samples": 7, "force": 1, "every": 5})");
    EXPECT_EQ(first["rows"][0]["first"], 0.0);
    EXPECT_EQ(first["rows"][0]["values"], 2);
    EXPECT_EQ(first.numbers("probe.0.0").size(), 2U);
    EXPECT_EQ(first["rows"][1]["values"], 0) << "the circuit is late";
    const auto second = ask_well(engine, R"({"request": "advance", "samples": 1000, "force": 1, "every": 5})");
    EXPECT_DOUBLE_EQ(second["rows"][0]["first"], 10e-4);
    EXPECT_EQ(second["rows"][1]["first"], 0.0);
    EXPECT_GT(second["rows"][1]["steps"].get<int>(), 0);
}

TEST(PageEngine, SaysWhetherAChangedRowGoesOnOrStartsAgain) {
    PageEngine engine;
    ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}, {"afferent": "sa1-circuit"}]})");
    ask_well(engine, R"({"request": "advance", "samples": 1000, "force": 1})");
    const auto model = ask_well(engine, R"({"request": "set", "row": 0, "set": ["V_th=0.4"]})");
    EXPECT_EQ(model["state"], "carried");
    const auto circuit = ask_well(engine, R"({"request": "set", "row": 1, "set": ["summer.N3B=8x4", "temp=37"]})");
    EXPECT_EQ(circuit["state"], "restarted");
    const auto answer = ask_well(engine, R"({"request": "advance", "samples": 10000, "force": 2})");
    EXPECT_GT(answer["rows"][0]["spikes"].get<int>(), 0);
    EXPECT_GT(answer["rows"][1]["spikes"].get<int>(), 0);
    for (const double t : answer.numbers("time")) EXPECT_GE(t, 0.1);
}

/// The codes of a converter of 12 bits do not fit into one of 8.
TEST(PageEngine, ARowWhoseStateDoesNotFitTheChangedSettingsStartsAgain) {
    PageEngine engine;
    ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1-kim"}]})");
    ask_well(engine, R"({"request": "advance", "samples": 10000, "force": 2})");
    EXPECT_EQ(ask_well(engine, R"({"request": "set", "row": 0, "set": ["bits=8"]})")["state"], "restarted");
    const auto answer = ask_well(engine, R"({"request": "advance", "samples": 10000, "force": 2})");
    EXPECT_FALSE(answer["rows"][0].contains("error")) << answer["rows"][0].dump();
    EXPECT_GT(answer["rows"][0]["spikes"].get<int>(), 0);
}

TEST(PageEngine, ALongRequestEndsWhenItIsStopped) {
    const std::string_view requests[] = {
        R"({"request": "monte-carlo", "afferent": "sa1-circuit", "chips": 1000, "rate": 100000, "stimulus": "sine", "stimulus_set": ["duration=100s"]})",
        R"({"request": "advance", "samples": 100000, "force": 1})"};
    for (const auto request : requests) {
        PageEngine engine;
        ask_well(engine, R"({"request": "start", "rate": 10, "rows": [{"afferent": "sa1-circuit"}]})");
        std::thread stopping([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            engine.stop();
        });
        EXPECT_EQ(ask(engine, request).error(), "the request was stopped");  // it would take hours
        stopping.join();
    }
}

TEST(PageEngine, GivesTheOperatingStateOfACircuit) {
    PageEngine engine;
    const auto start =
        ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}, {"afferent": "sa1-circuit"}]})");
    ask_well(engine, R"({"request": "advance", "samples": 1000, "force": 1})");
    const double due = 0.1 - start["rows"][1]["delay"].get<double>();
    const auto state = ask_well(engine, R"({"request": "operating", "row": 1})");
    EXPECT_NEAR(state["supply"], 0.7, 0.2);
    EXPECT_NEAR(state["time"], due, 0.1 * due);
    double dissipated = 0;
    std::size_t nodes = 0;
    std::vector<std::string> names;
    for (const auto& block : state["blocks"]) {
        dissipated += block["power"].get<double>(), nodes += block["nodes"].size();
        names.push_back(block["name"]);
        EXPECT_EQ(block["devices"].empty(), block["name"] == "top level") << block["name"] << ": it has only sources";
        EXPECT_FALSE(block["nodes"].empty()) << block["name"] << ": the nodes at its terminals, at least";
    }
    EXPECT_NEAR(dissipated / state["power"].get<double>(), 1, 0.05) << "the rest charges capacitors";
    EXPECT_GT(nodes, 20U);
    EXPECT_NE(std::find(names.begin(), names.end(), "summer"), names.end());
    EXPECT_TRUE(ask_well(engine, R"({"request": "operating", "row": 0})")["blocks"].empty());
}

TEST(PageEngine, SimulatesChipsInSlices) {
    PageEngine engine;
    const std::string request =
        R"({"request": "monte-carlo", "afferent": "sa1-circuit", "chips": 3, "seed": 5, "rate": 10000, "stimulus": "press")";
    const auto whole = ask_well(engine, request + "}");
    EXPECT_EQ(whole["done"], true);
    auto part = ask_well(engine, request + R"(, "slice": 0.001})");
    auto units = part.units();
    auto times = part.numbers("time");
    EXPECT_EQ(part["done"], false);
    for (int k = 0; k < 10000 && part["done"] == false; ++k) {
        part = ask_well(engine, R"({"request": "continue", "slice": 0.001})");
        const auto more_units = part.units();
        const auto more = part.numbers("time");
        units.insert(units.end(), more_units.begin(), more_units.end()), times.insert(times.end(), more.begin(), more.end());
    }
    EXPECT_EQ(units, whole.units());
    EXPECT_EQ(times, whole.numbers("time"));
    EXPECT_EQ(part["chips_done"], 3);
    const auto rows = whole["rows"];
    EXPECT_GT(rows[0]["spikes"].get<int>(), 0);
    // Chip 0 is the one that the mismatch override selects.
    const auto first = ask_well(engine, R"({"request": "respond", "rate": 10000, "stimulus": "press",
        "rows": [{"afferent": "sa1-circuit", "set": ["mismatch=5"]}]})")
                           .numbers("time");
    times = whole.numbers("time");
    EXPECT_EQ(first, std::vector(times.begin(), times.begin() + std::count(units.begin(), units.end(), 0U)));
    EXPECT_EQ(ask(engine, R"({"request": "continue"})").error(), "continue: nothing is being computed; send respond or monte-carlo first");
}

}  // namespace
}  // namespace corpuscle::page
