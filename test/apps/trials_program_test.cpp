// corpuscle respond with trials: a table of epochs, trials one below another, contacts, and many files.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text/ascii_text.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;

std::string example(const std::string& name) { return "'" + test::source_root() + "/examples/data/" + name + "'"; }

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

nlohmann::json json_of(const TemporaryFolder& folder, const std::string& arguments) {
    const auto ran = run_program(folder, "respond " + arguments + " --json");
    EXPECT_EQ(ran.status, 0) << arguments << ran.err;
    return nlohmann::json::parse(ran.out, nullptr, false);
}

/// The rows of one trial of a press of 1 s, as lines "time,force".
std::string press(int number, double from) {
    std::string text;
    for (int k = 0; k < 500; ++k) {
        const double t = k * 0.002, force = std::min(std::max((t - 0.2 - 0.02 * number) * 20, 0.0), 1.0 + 0.2 * number);
        text += fmt::format("{:.3f},{:.6f}\n", from + t, t < 0.8 ? force : 0);
    }
    return text;
}

/// Lines of a file with a text before each.
std::string prefixed(const std::string& prefix, const std::string& text) {
    std::string out;
    for (const auto& line : lines_of(text)) out += prefix + line + "\n";
    return out;
}

TEST(TrialsProgram, GivesEachTrialOfALongTableTheSpikesOfItsOwnFile) {
    const TemporaryFolder folder;
    for (const double gap : {0.0, 1.0}) {  // times restart in each trial, or go on
        std::string table = "time_s,fz_N,trial,texture\n";
        std::vector<std::string> rows;
        for (int n = 1; n <= 3; ++n) {
            folder.write(fmt::format("press_{}.csv", n), "time_s,fz_N\n" + press(n, gap * n));
            for (const auto& row : lines_of(press(n, gap * n))) rows.push_back(row + fmt::format(",{},{}\n", n, n == 2 ? "rough" : "smooth"));
        }
        for (const auto& row : rows) table += row;
        folder.write("long.csv", table);
        const auto split = json_of(folder, "long.csv --by trial --label texture --align onset --window -0.1..0.5 -a sa1,fa1-nerve"),
                   files = json_of(folder, "press_1.csv press_2.csv press_3.csv --align onset --window -0.1..0.5 -a sa1,fa1-nerve");
        ASSERT_EQ(split["trials"]["responses"].size(), 6U);
        EXPECT_EQ(split["trials"]["responses"], files["trials"]["responses"]);
        EXPECT_GT(split["trials"]["responses"][0]["times_s"].size(), 2U);
        for (std::size_t n = 0; n < 3; ++n)
            EXPECT_EQ(split["trials"]["trials"][n]["zero_s"], files["trials"]["trials"][n]["zero_s"]);
        EXPECT_EQ(split["trials"]["trials"][1]["label"], "rough");
        EXPECT_EQ(files["trials"]["trials"][1]["label"], "press") << "the name of the file without its number";
        EXPECT_EQ(split["trials"]["labels"].size(), 4U) << "two labels, two afferents";
        EXPECT_EQ(files["trials"]["labels"][0]["spikes"]["trials"], 3);
    }
}

TEST(TrialsProgram, ReadsTheSameTrialsFromRowsInAnyOrderOfTrials) {
    const TemporaryFolder folder;
    folder.write("sorted.csv", "trial,time_s,fz_N\n" + prefixed("1,", press(1, 0)) + prefixed("2,", press(2, 0)));
    const auto one = lines_of(prefixed("1,", press(1, 0))), two = lines_of(prefixed("2,", press(2, 0)));
    std::string mixed = "trial,time_s,fz_N\n";
    for (std::size_t k = 0; k < one.size(); ++k) mixed += one[k] + "\n" + two[k] + "\n";
    folder.write("mixed.csv", mixed);
    EXPECT_EQ(json_of(folder, "sorted.csv --by trial")["trials"]["responses"], json_of(folder, "mixed.csv --by trial")["trials"]["responses"]);
    folder.write("long.jsonl", [&] {
        std::string text;
        for (const auto& line : lines_of(mixed).size() ? lines_of(mixed) : one) {
            const auto parts = split(line, ',');
            if (parts[0] != "trial") text += fmt::format("{{\"trial\":{},\"time_s\":{},\"fz_N\":{}}}\n", parts[0], parts[1], parts[2]);
        }
        return text;
    }());
    EXPECT_EQ(json_of(folder, "sorted.csv --by trial")["trials"]["responses"], json_of(folder, "long.jsonl --by trial")["trials"]["responses"]);
}

TEST(TrialsProgram, CutsARecordingByATableOfEpochs) {
    const TemporaryFolder folder;
    folder.write("epochs.csv", "label,start_ms,stop_ms\nall,0,6000\nfirst,0,1500\nthen,1500,6000\n");
    const auto run = json_of(folder, example("touch.csv") + " --deadband 20mN --trials epochs.csv -a sa1-nerve");
    const auto& responses = run["trials"]["responses"];
    ASSERT_EQ(responses.size(), 3U);
    const auto count = [&](std::size_t k) { return responses[k]["spikes"].get<double>(); };
    EXPECT_EQ(run["trials"]["trials"][0]["label"], "first") << "in order of time";
    EXPECT_EQ(count(1), count(0) + count(2));
    EXPECT_EQ(count(1), run["spikes"][0]["times_s"].size());
    EXPECT_EQ(responses[1]["peak_rate_Hz"], run["rates"][0]["peak_rate_Hz"]) << "the same measure as of the complete recording";
}

TEST(TrialsProgram, WritesItsFilesAndReplacesOnlyItsOwn) {
    const TemporaryFolder folder;
    const auto command = "respond " + example("touch.csv") + " --deadband 20mN --trials onset --window -0.1..0.4 --bin 20ms -a sa1-nerve";
    const auto ran = run_program(folder, command + " -o out");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("4 contacts above"), std::string::npos);
    EXPECT_NE(ran.out.find("4 trials, aligned to contact onset"), std::string::npos);
    const auto trials = lines_of(test::read_file(folder / "out/trials.csv")), psth = lines_of(test::read_file(folder / "out/psth.csv"));
    ASSERT_EQ(trials.size(), 5U);
    EXPECT_TRUE(trials[0].starts_with("trial,label,input,start_s,stop_s,zero_s,from_s,to_s,afferent,channel,spikes,mean_rate_Hz,"));
    EXPECT_TRUE(trials[1].starts_with("1,contact,touch,")) << trials[1];
    ASSERT_EQ(psth.size(), 26U);
    EXPECT_EQ(psth[0], "label,afferent,channel,from_s,to_s,trials,spikes,rate_Hz,standard_error_Hz");
    EXPECT_TRUE(psth[1].starts_with("contact,sa1-nerve,fz,-0.100000000,-0.080000000,4,")) << psth[1];
    const auto summary = nlohmann::json::parse(test::read_file(folder / "out/summary.json"));
    EXPECT_EQ(summary["trials"]["trials"].size(), 4U);
    EXPECT_FALSE(summary["trials"].contains("responses")) << "they are in trials.csv";
    for (const auto* threads : {"-j 1", "-j 2"}) {
        EXPECT_EQ(run_program(folder, command + " -o again " + threads).status, 0);
        EXPECT_EQ(test::read_file(folder / "again/trials.csv"), test::read_file(folder / "out/trials.csv"));
        EXPECT_EQ(test::read_file(folder / "again/psth.csv"), test::read_file(folder / "out/psth.csv"));
    }
    std::filesystem::create_directory(folder / "own");
    folder.write("own/trials.csv", "start,stop,label\n0,1,a\n");
    const auto refused = run_program(folder, "respond press --trials own/trials.csv -o own");
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_EQ(test::read_file(folder / "own/trials.csv"), "start,stop,label\n0,1,a\n");
}

TEST(TrialsProgram, WorksForASkin) {
    const TemporaryFolder folder;
    folder.write("epochs.csv", "start,stop,label\n0,0.5,a\n0.5,1,a\n");
    const auto ran = run_program(folder, "respond press --population 'grid 2x2' --trials epochs.csv --bin 50ms -o out --report");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto psth = lines_of(test::read_file(folder / "out/psth.csv"));
    EXPECT_EQ(psth[0], "label,afferent,channel,afferents,from_s,to_s,trials,spikes,rate_Hz,standard_error_Hz");
    std::size_t spikes = 0;
    for (std::size_t k = 1; k < lines_of(test::read_file(folder / "out/trials.csv")).size(); ++k)
        spikes += std::stoul(std::string(split(lines_of(test::read_file(folder / "out/trials.csv"))[k], ',')[10]));
    std::size_t all = 0;
    for (const auto& line : lines_of(test::read_file(folder / "out/spikes.csv")))
        if (const auto time = split(line, ',').back(); time != "time_s") all += std::stod(std::string(time)) < 1;
    EXPECT_EQ(spikes, all);
}

TEST(TrialsProgram, RefusesWhatCannotBeWithARemedy) {
    const TemporaryFolder folder;
    folder.write("epochs.csv", "start,stop,label\n0,1,a\n7,8,late\n");
    folder.write("long.csv", "trial,time_s,fz_N\n" + prefixed("1,", press(1, 0)) + prefixed("2,", press(2, 0)));
    folder.write("bad.csv", "trial,time_s,fz_N\n1,0,1\n1,0.1,2\n2,0,1\n2,0.1,oops\n2,0.2,1\n");
    folder.write("empty.csv", "trial\tlabel\ttime_s\tfz\tb\t5.\x11\t800al\t\n");
    const std::tuple<std::string, int, const char*> cases[] = {
        {"press --trials epochs.csv", 1, "epochs.csv:3: trial 'late' from 7 s to 8 s is outside of the recording"},
        {"empty.csv --by trial", 1, "empty.csv: there are no rows in this table"},
        {"long.csv --by tral", 1, "--by tral: there is no such column; did you mean 'trial'?"},
        {"long.csv --by trial --label texture", 1, "--label texture: there is no such column"},
        {"bad.csv --by trial", 1, "bad.csv:5:7: column 'fz': 'oops' where a number is expected"},
        {"press --by trial", 2, "--by trial: press is a stimulus, which has no columns"},
        {"long.csv --by trial --trials epochs.csv", 2, "--by and --trials exclude each other"},
        {"press --window 0.5..0.1", 2, "write FROM..TO with FROM before TO"},
        {"press --window 5", 2, "--window 5: write FROM..TO"},
        {"press --align middle", 2, "--align"},
        {"press --onset-threshold 1N", 2, "--onset-threshold needs --align onset or --trials onset"},
        {"press --label x", 2, "--label x"},
        {"press --trials onset --onset-threshold 9N", 1, "no contact in press: the force never rises above 9 N"},
        {"long.csv --by trial --population 'grid 2x2'", 2, "--by cannot be used with --population"},
        {"press --trials none.csv", 1, "none.csv"},
        {"press --align start --bin 1ns --json", 2, "bins"},
    };
    for (const auto& [arguments, status, message] : cases) {
        const auto ran = run_program(folder, "respond " + arguments);
        EXPECT_EQ(ran.status, status) << arguments << ran.err;
        EXPECT_NE(ran.err.find(message), std::string::npos) << arguments << '\n' << ran.err;
    }
    const auto advised = run_program(folder, "respond long.csv");
    EXPECT_NE(advised.err.find("--by trial"), std::string::npos) << advised.err;
    EXPECT_EQ(run_program(folder, "respond long.csv --by trial").status, 0) << "the remedy works";
}

}  // namespace
}  // namespace corpuscle
