// The requests of the page that are not simulations, and refused ones.

#include <fmt/format.h>
#include <algorithm>
#include <fstream>

#include "io/recording/recording_options.hpp"
#include "io/spikes/spike_files.hpp"
#include "page/ask.hpp"
#include "page/temporary_directory.hpp"
#include "support/support.hpp"

namespace corpuscle::page {
namespace {

using test::value_or_throw;

const Json* find_named(const Json& list, std::string_view name) {
    for (const auto& entry : list)
        if (entry["name"] == name) return &entry;
    return nullptr;
}

TEST(PageRequests, TheCatalogueHasAfferentsSkinsAndIndenters) {
    PageEngine engine;
    const auto answer = ask_well(engine, R"({"request": "catalogue", "id": 7})");
    EXPECT_EQ(answer["id"], 7);
    const auto* model = find_named(answer["afferents"], "sa1-nerve");
    ASSERT_NE(model, nullptr);
    EXPECT_EQ((*model)["class"], "sa1");
    EXPECT_EQ((*model)["is_circuit"], false);
    EXPECT_EQ((*model)["composition"], "slowly-adapting+alif");
    EXPECT_FALSE((*model)["description"].empty());
    const auto* chip = find_named(answer["afferents"], "sa1-circuit");
    ASSERT_NE(chip, nullptr);
    EXPECT_EQ((*chip)["class"], "sa1");
    EXPECT_EQ((*chip)["is_circuit"], true);
    EXPECT_NE(find_named(answer["sections"]["stimuli"], "press"), nullptr);
    EXPECT_GT((*find_named(answer["populations"], "fingertip"))["afferents"].get<int>(), 100);
    EXPECT_NE(find_named(answer["indenters"], "grating"), nullptr);
}

TEST(PageRequests, ACircuitHasSettableValues) {
    PageEngine engine;
    const auto answer = ask_well(engine, R"({"request": "settable", "afferent": "sa1-circuit"})");
    const auto& settable = answer["settable"];
    const auto* array = find_named(settable, "summer.n3b");
    ASSERT_NE(array, nullptr);
    EXPECT_EQ((*array)["value"], "12x4");
    EXPECT_EQ((*array)["block"], "summer");
    const auto* width = find_named(settable, "summer.n3b.w");
    ASSERT_NE(width, nullptr);
    EXPECT_DOUBLE_EQ((*width)["value"], 1e-6);
    EXPECT_EQ((*find_named(settable, "corner"))["choices"].dump(), R"(["tt","ss","ff","sf","fs","mc"])");
    EXPECT_TRUE(ask_well(engine, R"({"request": "settable", "afferent": "sa1-nerve"})")["settable"].empty());
}

TEST(PageRequests, AListHasALimit) {
    PageEngine engine;
    Json request = {{"request", "schematic"}, {"afferent", "sa1-circuit"}, {"set", Json::array()}};
    for (int k = 0; k < 2049; ++k) request["set"].push_back("temp=30");
    const auto error = ask(engine, request.dump()).error();
    EXPECT_NE(error.find("\"set\" is"), std::string::npos) << error;
    EXPECT_NE(error.find("expected a list of at most 2048 texts"), std::string::npos) << error;
}

/// Each value that is offered can be set to its present value.
TEST(PageRequests, EachSettableValueOfAChipIsAccepted) {
    PageEngine engine;
    const auto answer = ask_well(engine, R"({"request": "settable", "afferent": "fa1-circuit"})");
    Json start = {{"request", "start"}, {"rate", 10000}, {"rows", {{{"afferent", "fa1-circuit"}, {"set", Json::array()}}}}};
    for (const auto& value : answer["settable"]) {
        if (value["name"] == "corner" || value["value"].is_null()) continue;  // without a value it is that of the netlist
        const auto text = value["value"].is_string() ? value["value"].get<std::string>() : fmt::format("{}", value["value"].get<double>());
        start["rows"][0]["set"] = {fmt::format("{}={}", value["name"].get<std::string>(), text)};
        EXPECT_EQ(ask(engine, start.dump()).error(), "") << start.dump();
    }
}

TEST(PageRequests, TheSeedOfARequestChangesTheNoise) {
    PageEngine engine;
    const auto times = [&](int seed) {
        return ask_well(
                   engine,
                   fmt::format(
                       R"({{"request": "respond", "rate": 2000, "seed": {}, "stimulus": "press", "rows": [{{"afferent": "sa1-nerve"}}]}})",
                       seed))
            .numbers("time");
    };
    EXPECT_EQ(times(1), times(1));
    EXPECT_NE(times(1), times(2));
}

TEST(PageRequests, ProbesWithTooManyValuesAreRefused) {
    PageEngine engine;
    const auto answer = ask(
        engine,
        R"({"request": "respond", "rate": 1000000, "stimulus": "press", "every": 1, "rows": [{"afferent": "sa1"}, {"afferent": "fa1"}, {"afferent": "sa1-circuit"}, {"afferent": "fa1-circuit"}]})");
    EXPECT_NE(answer.error().find("choose a larger"), std::string::npos) << answer.error();
}

TEST(PageRequests, ASchematicIsDrawn) {
    PageEngine engine;
    const auto answer = ask_well(engine, R"({"request": "schematic", "afferent": "sa1-circuit"})");
    const auto* svg = answer.message.find("svg");
    const std::string text(reinterpret_cast<const char*>(svg->data.data()), svg->data.size());
    EXPECT_TRUE(text.starts_with("<svg")) << text.substr(0, 80);
    EXPECT_NE(text.find("xcco"), std::string::npos);
    EXPECT_NE(ask_well(engine, R"({"request": "schematic", "afferent": "sa1-circuit", "block": "summer"})").message.find("svg"), nullptr);
    EXPECT_EQ(ask(engine, R"({"request": "schematic", "afferent": "sa1"})").error(),
              "an afferent of equations has no schematic; a circuit, such as sa1-circuit, has one");
}

TEST(PageRequests, ARecordingIsReadFromItsBytes) {
    PageEngine engine;
    const std::string text = "time_s,left_N,right_N\n0,0,1\n0.01,0.5,1\n0.02,1,1\n0.03,1,1\n";
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const auto answer = ask(engine, R"({"request": "read", "name": "two.csv"})", "file", bytes);
    ASSERT_EQ(answer.error(), "");
    EXPECT_EQ(answer["rate"], 100.0);
    EXPECT_EQ(answer["samples"], 4);
    EXPECT_EQ(answer["channels"].size(), 2U);
    EXPECT_EQ(answer.numbers("force.0"), (std::vector<double>{0, 0.5, 1, 1}));
    const auto scaled =
        ask(engine, R"({"request": "read", "name": "two.csv", "options": {"channel": "2", "scale": "2", "rate": "50Hz"}})", "file", bytes);
    ASSERT_EQ(scaled.error(), "");
    EXPECT_EQ(scaled["rate"], 50.0);
    EXPECT_EQ(scaled.numbers("force.0"), (std::vector{2.0, 2.0, 2.0, 2.0}));
    const auto both =
        ask(engine, R"({"request": "read", "name": "two.csv", "options": {"channel": ["right", "left"], "abs": "true"}})", "file", bytes);
    ASSERT_EQ(both.error(), "");
    EXPECT_EQ(both["channels"].size(), 2U);
    EXPECT_EQ(ask(engine, R"({"request": "read", "name": "two.csv", "options": {"channel": [1]}})", "file", bytes).error(),
              "read: the option \"channel\" is not a text, such as \"100Hz\", nor a list of texts");
    const auto skipped = ask(
        engine, R"({"request": "read", "name": "two.csv", "options": {"skip": ".2e1", "time": "none", "rate": "1kHz"}})", "file", bytes);
    EXPECT_EQ(skipped["samples"], 3) << skipped.error();  // the heading and one row less
    const auto wrong = ask(engine, R"({"request": "read", "name": "two.csv"})", "file", std::vector<std::uint8_t>{'x', '\n', 'y', '\n'});
    EXPECT_NE(wrong.error(), "");
    EXPECT_EQ(wrong.error().find("/tmp"), std::string::npos) << wrong.error();
}

TEST(PageRequests, OptionsOfARecordingAreRefusedAsOnTheCommandLine) {
    PageEngine engine;
    const auto read = [&](const std::string& options, const std::string& text) {
        return ask(engine, fmt::format(R"({{"request": "read", "name": "x.csv", "options": {}}})", options), "file",
                   std::vector<std::uint8_t>(text.begin(), text.end()));
    };
    const std::string wide = "1,2,3,4\n5,6,7,8\n";
    EXPECT_EQ(read(R"({"rate": "1kHz", "transpose": "true"})", wide)["channels"].size(), 2U);
    EXPECT_EQ(read(R"({"rate": "1kHz", "no-transpose": "true"})", wide)["channels"].size(), 4U);
    EXPECT_EQ(read(R"({"rate": "1kHz", "no-transpose": "true", "transpose": "true"})", wide).error(),
              "no-transpose and transpose exclude each other; give one of them");
    EXPECT_EQ(read(R"({"rate": ["1kHz", "2kHz"]})", wide).error(), "rate is given twice; give it once");
    EXPECT_EQ(read(R"({"layout": "x.csv"})", wide).error(),
              "read: the page reads one file, without a layout; use the option --layout of `corpuscle respond`");
    const auto unknown = read(R"({"no-such": "1"})", wide).error();
    EXPECT_TRUE(unknown.starts_with("unknown option no-such; there are channel, ")) << unknown;
    EXPECT_EQ(unknown.find("layout"), unknown.npos) << unknown;
}

TEST(PageRequests, ARemedyThatThePageDoesNotHaveIsThatOfTheCommandLine) {
    PageEngine engine;
    std::string text = "a_N,b_N,sum_N\n";
    for (int k = 0; k < 400; ++k) text += fmt::format("{},{},{}\n", k % 7, k % 11, k % 7 + k % 11);
    const auto answer = ask(engine, R"({"request": "read", "name": "x.csv", "options": {"rate": "1kHz"}})", "file",
                            std::vector<std::uint8_t>(text.begin(), text.end()));
    ASSERT_EQ(answer.error(), "");
    const auto notes = answer["notes"].get<std::vector<std::string>>();
    EXPECT_EQ(std::ranges::count(notes,
                                 "'sum' is the sum of 'a' to 'b', not a sensor of its own; use --channel or --layout to exclude it "
                                 "(--layout: only in `corpuscle respond`)"),
              1)
        << answer["notes"].dump();
}

TEST(PageRequests, AResponseHasItsWarningsAndGoesOnInAnySlice) {
    PageEngine engine;
    auto answer =
        ask_well(engine, R"({"request": "respond", "rate": 100, "stimulus": "press", "rows": [{"afferent": "fa2"}], "slice": 1e-12})");
    for (int k = 0; k < 10'000 && answer["done"] == false; ++k) answer = ask_well(engine, R"({"request": "continue", "slice": 1e-12})");
    ASSERT_EQ(answer["done"], true);
    EXPECT_EQ(answer["warnings"],
              Json::array({"fa2 on press: the sample rate is 100 Hz, but this afferent needs 1000 Hz or more: vibration above 50 Hz is "
                           "missing, and the afferent responds to the slower part of the force only",
                           "fa2: on press several spikes come within one sample of 10 ms, so their rates are left out; record at 1 kHz or "
                           "more, or read a recording with --resample 2kHz --interpolation smooth"}));
}

TEST(PageRequests, TheSpikesSinceTheStartAreSavedAsCsv) {
    PageEngine engine;
    ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}, {"afferent": "sa1"}]})");
    const auto advanced = ask_well(engine, R"({"request": "advance", "samples": 5000, "force": 2})");
    const auto saved = ask_well(engine, R"({"request": "save"})");
    EXPECT_EQ(saved["name"], "spikes.csv");
    const auto* file = saved.message.find("file");
    const std::string text(reinterpret_cast<const char*>(file->data.data()), file->data.size());
    EXPECT_TRUE(text.starts_with("afferent,channel,time_s\nsa1,force,")) << text.substr(0, 60);
    EXPECT_NE(text.find("sa1#2,force,"), std::string::npos);
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), 1 + advanced.numbers("time").size());
}

TEST(PageRequests, SavedSpikesAsNwbAreThoseOfTheSession) {
    PageEngine engine;
    const auto started =
        ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}], "skin": {"population": "fingertip"}})");
    EXPECT_EQ(started["formats"], Json::array({"csv", "nwb"}));
    const auto advanced = ask_well(engine, R"({"request": "advance", "samples": 3000, "force": 2})");
    const auto force = std::vector<double>(1000, 2.0);
    const auto saved = ask(engine, R"({"request": "save", "format": "nwb", "force_from": 2000})", "force", force);
    ASSERT_EQ(saved.error(), "");
    EXPECT_EQ(saved["name"], "spikes.nwb");
    const auto directory = value_or_throw(TemporaryDirectory::make());
    const auto path = directory.file("saved.nwb");
    const auto* file = saved.message.find("file");
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(file->data.data()), static_cast<long>(file->count));

    std::vector<double> found;
    std::size_t of_row = 0;
    for (const auto& train : value_or_throw(read_spikes(path, {}))) {
        found.insert(found.end(), train.times.begin(), train.times.end());
        if (train.afferent == "sa1") of_row = train.times.size();
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, advanced.numbers("time"));
    EXPECT_EQ(of_row, advanced["rows"][0]["spikes"]);
    EXPECT_GT(of_row, 1U);
    const auto recording = value_or_throw(open_recording(path, {}));
    EXPECT_EQ(recording->clock().rate(), 10000);
    EXPECT_EQ(recording->clock().t0, 0.2);

    EXPECT_EQ(ask(engine, R"({"request": "save", "format": "nwb", "force_from": 2001})", "force", force).error(),
              "save: the force ends after sample 3000, the last one that was simulated");
    EXPECT_EQ(ask(engine, R"({"request": "save", "format": "mat"})").error(), "save: there is no format 'mat' (there are csv and nwb)");
}

TEST(PageRequests, TheIndenterChangesWhileTheSimulationGoesOn) {
    PageEngine engine;
    ask_well(engine, R"({"request": "start", "rate": 1000, "skin": {"population": "fingertip"}})");
    const auto answer = ask_well(engine, R"({"request": "contact", "indenter": "grating", "set": ["period=2mm"]})");
    EXPECT_NE(answer["contact"].get<std::string>().find("grating with a ridge every 2 mm"), std::string::npos) << answer["contact"];
    EXPECT_EQ((*find_named(answer["contact_parameters"], "period"))["value"], 2e-3);
    EXPECT_EQ((*find_named(answer["contact_parameters"], "speed"))["value"], 0);
    EXPECT_EQ(find_named(answer["contact_parameters"], "x"), nullptr) << "the position is the page's";
    ask_well(engine, R"({"request": "advance", "samples": 100, "force": 1, "shear_x": 0.2, "shear_y": 0})");
    const auto flat = ask_well(engine, R"({"request": "contact", "indenter": "flat", "set": ["tilt=20"]})");
    EXPECT_EQ((*find_named(flat["contact_parameters"], "tilt"))["value"], 20);
    for (const char* absent : {"E_star", "speed"}) EXPECT_EQ(find_named(flat["contact_parameters"], absent), nullptr) << absent;
    ask_well(engine, R"({"request": "contact", "indenter": "grating"})");
    EXPECT_EQ(ask(engine, R"({"request": "contact", "indenter": "grating", "set": ["x=2mm"]})").error(),
              "x=2mm: the position of the contact is that of each request `advance`");
}

TEST(PageRequests, RefusedOnesNameTheFaultAndKeepTheSession) {
    PageEngine engine;
    EXPECT_EQ(ask(engine, R"({"request": "advance", "samples": 10})").error(),
              "advance: there is no session; send the request \"start\" first");
    ask_well(engine, R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1"}]})");
    const std::pair<const char*, const char*> refused[] = {
        {R"({"request": "advance", "samples": 10, "forces": 1})", "advance: unknown key 'forces'; did you mean 'force'? (it has "},
        {R"({"request": "advance", "samples": 0})", "advance: \"samples\" is 0; expected an integer from 1 to 100000"},
        {R"({"request": "advance", "samples": 10, "x": 1})", "advance: give both x and y, or neither"},
        {R"({"request": "advance", "samples": 10, "force": null})", "advance: \"force\" is null; expected a number"},
        {R"({"request": "advanse"})", "there is no request 'advanse'; did you mean 'advance'?"},
        {R"({"request": "start", "rate": 10000, "rows": [{"afferent": "circuits/own.cir"}]})",
         "'circuits/own.cir' is the path of a file; the page has built-in circuits and equations only; type: corpuscle respond press "
         "--afferent circuits/own.cir"},
        {R"({"request": "start", "rate": 10000, "skin": {"population": "own.toml"}})", "there is no population 'own.toml'"},
        {R"({"request": "start", "rate": 10000, "skin": {"population": "README"}})", "there is no population 'README'"},
        {R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1", "probes": ["vf"]}]})", "sa1: \"probes\" are for circuits"},
        {R"({"request": "start", "rate": 10000, "rows": [{"afferent": "sa1", "set": ["f_b=25Hz"]}]})",
         "sa1: unknown parameter 'f_b'; did you mean 'f_B'?"},
        {R"({"request": "start", "rate": 1e9})", "start: \"rate\" is 1000000000.0; expected a number from 10 to 1e+06"},
        {R"({"request": "set", "row": 3})", "set: there is no row 3; the session has 1"},
        {R"({"request": "respond", "rate": 10000})", "respond: give either a \"stimulus\" or the array \"force\""},
        {R"({"request": "monte-carlo", "afferent": "sa1", "chips": 2, "rate": 10000, "stimulus": "press"})",
         "sa1: unknown parameter 'mismatch'"},
        {"[]", "a message needs at least 4 bytes"},
        {"", "a message needs at least 4 bytes"},
    };
    for (const auto& [request, expected] : refused) {
        const auto error = ask(engine, request).error();
        EXPECT_EQ(error.substr(0, std::string_view(expected).size()), expected) << request;
    }
    const auto too_long = ask(engine, R"({"request": "advance", "samples": 3})", "force", std::vector{1.0, 2.0});
    EXPECT_EQ(too_long.error(), "advance: the array 'force' has 2 values for 3 samples");
    const auto mistyped = ask(engine, R"({"request": "advance", "samples": 2})", "Force", std::vector{1.0, 2.0});
    EXPECT_EQ(mistyped.error().substr(0, 59), "advance: unknown array 'Force'; did you mean 'force'? (it h");
    EXPECT_EQ(ask_well(engine, R"({"request": "advance", "samples": 10, "force": 1})")["from"], 0);
}

}  // namespace
}  // namespace corpuscle::page
