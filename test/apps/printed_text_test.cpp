// Printed text: help that fits the width, names without control characters, reported commands without the names of directories.

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/text/utf8.hpp"
#include "io/spikes/spike_files.hpp"
#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;
using Json = nlohmann::json;

std::size_t widest_line(const std::string& text) {
    std::size_t widest = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        widest = std::max(widest, static_cast<std::size_t>(std::count_if(
                                      line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; })));
    return widest;
}

/// True for valid UTF-8 without control characters (except line feeds) and without marks of text direction.
bool is_harmless(const std::string& text) {
    for (const std::string mark : {"\xe2\x80\xae", "\xe2\x80\x8f", "\xe2\x81\xa6", "\xc2\x9b", "\x7f"})
        if (text.find(mark) != text.npos) return false;
    return is_utf8(text) && std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 32 && c != '\n'; });
}

TEST(PrintedText, HelpFitsInAHundredColumnsAndShowsExamplesFirst) {
    const TemporaryFolder folder;
    for (const std::string verb : {"", "respond", "compare", "study", "run", "export", "sweep", "sweep show", "sweep merge", "sweep dump",
                                   "sweep calibrate", "stream", "list"}) {
        const auto help = test::run_program(folder, verb + " --help");
        EXPECT_EQ(help.status, 0) << verb;
        EXPECT_LE(widest_line(help.out), 100U) << verb;
        const auto example = help.out.find("\n  corpuscle "), options = help.out.find("\nOptions:");
        ASSERT_NE(options, help.out.npos) << help.out;
        EXPECT_TRUE(verb == "study" || example < options) << verb;
        EXPECT_EQ(test::run_program(folder, "help " + verb).out, help.out) << verb;
    }
}

TEST(PrintedText, TheProgramWithoutArgumentsPrintsHelpAndAWrongVerbGetsASuggestion) {
    const TemporaryFolder folder;
    const auto without_arguments = test::run_program(folder, "");
    EXPECT_EQ(without_arguments.status, 0);
    EXPECT_EQ(without_arguments.out, test::run_program(folder, "--help").out);
    const auto wrong = test::run_program(folder, "resond press");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_EQ(wrong.err, "corpuscle: unknown verb 'resond'; did you mean 'respond'?\n");
    const auto far = test::run_program(folder, "frobnicate");
    EXPECT_EQ(far.status, 2);
    EXPECT_NE(far.err.find("unknown verb 'frobnicate'; the verbs are respond, compare"), std::string::npos) << far.err;
    for (const std::string verb : {"respond", "stream", "sweep show", "list"})
        EXPECT_EQ(test::run_program(folder, verb + " --version").out, test::run_program(folder, "--version").out) << verb;
}

TEST(PrintedText, HelpStatesTheLargestAcceptedNumberOfChannels) {
    const TemporaryFolder folder;
    EXPECT_NE(test::run_program(folder, "stream --help").out.find("[1 - 4194304]"), std::string::npos);
    EXPECT_EQ(test::run_program(folder, "stream --rate 1kHz --channels 4194305 < /dev/null").status, 2);
}

TEST(PrintedText, TheNameOfAReportMustEndInHtml) {
    const TemporaryFolder folder;
    for (const std::string arguments : {"respond press --report x.pdf", "respond press --report my_report", "study fig3 --report x",
                                        "sweep show r.sqlite --report r.sqlite"}) {
        const auto ran = test::run_program(folder, arguments);
        EXPECT_EQ(ran.status, 2) << arguments;
        EXPECT_NE(ran.err.find("the name must end in .html, such as "), std::string::npos) << ran.err;
    }
    EXPECT_TRUE(folder.file_names().empty());
    EXPECT_EQ(test::run_program(folder, "respond --report press -q").status, 0) << "a stimulus after --report is a force";
    EXPECT_EQ(folder.file_names(), std::vector<std::string>{"report.html"});
}

TEST(PrintedText, ARecordingAfterReportIsRefusedWithTheRightOrder) {
    const TemporaryFolder folder;
    for (const auto* const name : {"a.csv", "b 2.csv"}) folder.write(name, "time_s,fz_N\n0,0\n0.001,1\n0.002,1\n");
    for (const auto& [arguments, remedy] : {std::pair{"respond a.csv --report a.csv", "respond a.csv --report"},
                                            {"respond a.csv --report 'b 2.csv'", "respond a.csv 'b 2.csv' --report"},
                                            {"respond press --report=sine", "respond press sine --report"}}) {
        const auto ran = test::run_program(folder, arguments);
        EXPECT_EQ(ran.status, 2) << arguments;
        EXPECT_NE(ran.err.find("the name must end in .html, such as "), std::string::npos) << ran.err;
        EXPECT_NE(ran.err.find(std::string("corpuscle ") + remedy + "\n"), std::string::npos) << ran.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
        EXPECT_EQ(test::run_program(folder, remedy).status, 0) << remedy;
        EXPECT_TRUE(std::filesystem::remove(folder / "report.html"));
    }
    EXPECT_EQ(test::run_program(folder, "respond --report a.csv -q").status, 0) << "the only force";
}

TEST(PrintedText, NamesFromFilesArePrintedWithoutControlCharacters) {
    const TemporaryFolder folder;
    std::string text =
        "time_s,\"a\x1b]0,title\x07"
        "b_N\",\"c\xc2\x9b"
        "d_N\",\"e\xe2\x80\xae"
        "f_N\",g\xe9_N\n";
    for (int k = 0; k < 300; ++k) text += fmt::format("{},{},2,3,1\n", 0.001 * k, k % 100 < 50 ? 0 : 2);
    folder.write("c.csv", text);
    folder.write("n.cir", "a \x1b[31m title\nv1 in 0 1\nr1 in 0 1k\n.op\n.expect v(in) 2 1e-9\n");
    for (const std::string arguments :
         {"respond c.csv -o c", "respond c.csv --json", "respond c.csv --channel \"$(printf 'x\\033[31mz')\"",
          "respond \"$(printf 'no\\nname\\033')\"", "compare c/spikes.csv c/spikes.csv", "compare c/spikes.csv c/spikes.csv --json",
          "run n.cir", "run n.cir --json", "run \"$(printf 'no\\033.cir')\"", "\"$(printf 'verb\\033')\"",
          "respond \"$(printf -- '--x\\033')\""}) {
        const auto ran = test::run_program(folder, arguments);
        EXPECT_TRUE(is_harmless(ran.out)) << arguments << '\n' << ran.out;
        EXPECT_TRUE(is_harmless(ran.err)) << arguments << '\n' << ran.err;
    }
    const auto table = test::run_program(folder, "respond c.csv").out;
    EXPECT_NE(table.find("a\\x1b]0,title\\x07b"), std::string::npos) << table;
    EXPECT_NE(table.find("e\\u202ef"), std::string::npos) << table;
    EXPECT_EQ(Json::parse(test::run_program(folder, "respond c.csv --json").out)["inputs"][0]["channels"][0],
              "a\x1b]0,title\x07"
              "b")
        << "data are not changed";
}

TEST(PrintedText, SpikesCsvIsUtf8AndNamesAreReadBackUnchanged) {
    const TemporaryFolder folder;
    std::string text = "time_s,Kraft f\xfcr_N,\"h \"\"q, r\"\" i_N\",=cmd|x_N\n";
    for (int k = 0; k < 500; ++k) text += fmt::format("{0},{1},{1},{1}\n", 0.001 * k, k % 100 < 50 ? 0 : 2);
    folder.write("c.csv", text);
    ASSERT_EQ(test::run_program(folder, "respond c.csv -o c -q").status, 0);
    EXPECT_TRUE(is_utf8(test::read_file(folder / "c/spikes.csv")));
    std::set<std::string> channels;
    for (const auto& train : test::value_or_throw(read_spikes(folder / "c/spikes.csv"))) channels.insert(train.channel);
    EXPECT_EQ(channels, (std::set<std::string>{"Kraft f\xc3\xbcr", "h \"q, r\" i", "=cmd|x"}));
    EXPECT_EQ(to_utf8("\x80 \xb5"), "\xe2\x82\xac \xc2\xb5") << "Windows' euro, Latin-1's micro";
}

TEST(PrintedText, PagesAndSummariesNameNoDirectories) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "secret/deep");
    std::string text = "t_s,fz_N\n";
    for (int k = 0; k < 300; ++k) text += fmt::format("{},{}\n", 0.001 * k, k % 100 < 50 ? 0 : 2);
    folder.write("secret/deep/f.csv", text);
    folder.write("secret/deep/layout.csv", "channel,name,x_mm,y_mm\nfz,thumb,1,2\n");
    const auto at = folder / "secret/deep/";
    ASSERT_EQ(test::run_program(folder, "respond '" + at + "f.csv' --layout='" + at + "layout.csv' -o secret/answer --report -q").status,
              0);
    for (const char* name : {"report.html", "summary.json", "spikes.csv"})
        EXPECT_EQ(test::read_file(folder / ("secret/answer/" + std::string(name))).find("secret"), std::string::npos) << name;
    EXPECT_NE(
        test::read_file(folder / "secret/answer/report.html").find("corpuscle respond f.csv --layout=layout.csv -o answer --report -q"),
        std::string::npos);
}

TEST(PrintedText, NoPageNamesTheDirectoriesOfNetlistsPopulationsAndSweeps) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "secret/deep");
    const auto at = folder / "secret/deep/";
    folder.write("secret/deep/own.cir", test::read_file(test::source_root() + "/circuits/spiker.cir"));
    folder.write("secret/deep/own.toml", test::read_file(test::source_root() + "/skins/fingertip.toml"));
    folder.write("secret/deep/sweep.toml",
                 "afferent = \"" + at +
                     "own.cir\"\nmeasures = [\"spikes\"]\n[[vary]]\nwhat = \"press.F_max\"\nfrom = \"1N\"\nto = \"2N\"\ncount = 2\n");
    for (const auto& command :
         {"respond press -a sa1," + at + "own.cir --report page.html", "respond press --population " + at + "own.toml --report page.html",
          "sweep show " + at + "results.sqlite --report page.html"}) {
        if (command.starts_with("sweep")) {
            ASSERT_EQ(test::run_program(folder, "sweep " + at + "sweep.toml -o " + at + "results.sqlite -q").status, 0);
        }
        ASSERT_EQ(test::run_program(folder, command + " --overwrite -q").status, 0) << command;
        const auto page = test::read_file(folder / "page.html");
        EXPECT_EQ(page.find("secret"), std::string::npos)
            << command << ": " << page.substr(page.find("secret") - std::min<std::size_t>(page.find("secret"), 80), 200);
        EXPECT_NE(page.find("--report page.html"), std::string::npos) << command;
    }
}

TEST(PrintedText, TheJsonDocumentHasTheTimeOfEverySpike) {
    const TemporaryFolder folder;
    const auto document = Json::parse(test::run_program(folder, "respond press noise -a sa1,fa1 --json -o a").out);
    std::size_t count = 0;
    for (const auto& unit : document["spikes"]) count += unit["times_s"].size();
    ASSERT_EQ(document["spikes"].size(), 4U);
    EXPECT_EQ(document["spikes"][1]["afferent"], "fa1");
    std::size_t rows = 0;
    for (const auto& train : test::value_or_throw(read_spikes(folder / "a/spikes.csv"))) rows += train.times.size();
    EXPECT_EQ(count, rows);
    EXPECT_NEAR(document["spikes"][0]["times_s"][0].get<double>(), 0.319558712, 1e-9);
    EXPECT_FALSE(Json::parse(test::read_file(folder / "a/summary.json")).contains("spikes")) << "spikes.csv has them";
}

TEST(PrintedText, TheJsonDocumentHasTheSpikesOfAPopulation) {
    const TemporaryFolder folder;
    const auto document = Json::parse(test::run_program(folder, "respond press --population 'grid 3x3' --json -o a").out);
    const auto trains = test::value_or_throw(read_spikes(folder / "a/spikes.csv"));
    ASSERT_GT(trains.size(), 2U);
    ASSERT_EQ(document["spikes"].size(), trains.size()) << "afferents that fired";
    for (const auto& unit : document["spikes"]) {
        const auto name = unit["afferent"].get<std::string>();
        const auto same = std::find_if(trains.begin(), trains.end(), [&](const auto& t) { return t.afferent == name; });
        ASSERT_NE(same, trains.end()) << name;
        EXPECT_EQ(same->channel, unit["channel"].get<std::string>());
        ASSERT_EQ(same->times.size(), unit["times_s"].size());
        for (std::size_t k = 0; k < same->times.size(); ++k) EXPECT_NEAR(same->times[k], unit["times_s"][k].get<double>(), 1e-9);
    }
    EXPECT_FALSE(Json::parse(test::read_file(folder / "a/summary.json")).contains("spikes"));
}

TEST(PrintedText, TablesFitInAHundredColumnsAndHaveNoMinusZero) {
    const TemporaryFolder folder;
    std::string text = "t_s,fz_N\n";
    for (int k = 0; k < 300; ++k) text += fmt::format("{},{}\n", 0.001 * k, k % 100 < 50 ? 0 : 2);
    folder.write("f.csv", text);
    ASSERT_EQ(test::run_program(folder, "respond press -a sa1,sa1-kim -o a -q").status, 0);
    for (const std::string arguments :
         {"compare a/spikes.csv a/spikes.csv", "respond press -a sa1,sa1-kim --copies 9 --spread sa1.f_B=10%"})
        EXPECT_LE(widest_line(test::run_program(folder, arguments).out), 100U) << test::run_program(folder, arguments).out;
    EXPECT_NE(test::run_program(folder, "respond f.csv --scale=-1").out.find(", -2 to 0 N\n"), std::string::npos)
        << test::run_program(folder, "respond f.csv --scale=-1").out;
}

TEST(PrintedText, OperatingPointsFitInAHundredColumnsWithEveryValue) {
    const TemporaryFolder folder;
    for (const std::string name : {"bias", "sa1", "spiker"}) {
        const auto ran = test::run_program(folder, "run '" + test::source_root() + "/circuits/" + name + ".cir'");
        EXPECT_LE(widest_line(ran.out), 100U) << ran.out;
    }
    const auto bias = test::run_program(folder, "run '" + test::source_root() + "/circuits/bias.cir'").out;
    const auto count = [&](const std::string& arguments) {
        std::size_t found = 0;
        for (auto at = bias.find(arguments); at != bias.npos; at = bias.find(arguments, at + 1)) ++found;
        return found;
    };
    for (const std::string column : {" i_d", " g_mb", " c_gs", " c_bd\n"}) EXPECT_EQ(count(column), 1U) << column << bias;
    EXPECT_EQ(count("\nm1a "), 3U) << "sixteen values on three lines";
    EXPECT_EQ(count("  moderate, saturation\n"), 7U) << bias;
    EXPECT_EQ(count("  weak, saturation\n"), 4U) << bias;
}

TEST(PrintedText, ALowSamplingRateIsReportedInTheSameWordsByEveryVerb) {
    const TemporaryFolder folder;
    std::string recording = "time_s,force_N\n";
    for (int k = 0; k < 100; ++k) recording += fmt::format("{:.3f},{}\n", k / 500.0, k % 10 / 10.0);
    folder.write("slow.csv", recording);
    for (const std::string command :
         {"respond slow.csv --afferent fa2", "respond slow.csv --population fingertip", "stream --in slow.csv -p fa2"})
        EXPECT_NE(
            test::run_program(folder, command)
                .err.find("the sample rate is 500 Hz, but this afferent needs 1000 Hz or more: vibration above 250 Hz is missing, and "
                          "the afferent responds to the slower part of the force only"),
            std::string::npos)
            << command;
}

}  // namespace
}  // namespace corpuscle
