// The program as a user runs it: what it prints, writes and returns.

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "circuit/variant/netlist_overrides.hpp"
#include "support/child_process.hpp"
#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;
using Json = nlohmann::json;

using test::run_program;

TEST(Program, PressPrintsTheTableAndWritesNoUnrequestedFile) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("sa1       press    plateau           9  36.0  49.0   49.0  29.8"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("Nothing was written"), std::string::npos);
    EXPECT_EQ(ran.err, "");
    EXPECT_TRUE(folder.file_names().empty());
}

TEST(Program, ImplementationsOfOneAfferentTypeAreComparedWithTheReference) {
    const TemporaryFolder folder;
    for (const std::string name : {"circuits", "process"})
        std::filesystem::create_directory_symlink(test::source_root() + "/" + name, folder / name);
    const std::string netlist = "circuits/sa1.cir";  // a relative path, because the width of the table depends on it
    const auto ran = run_program(folder, "respond press --afferent sa1 --afferent " + netlist + " --afferent fa1 --out answer");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto table = ran.out.substr(std::min(ran.out.find("implementation "), ran.out.size()));
    EXPECT_NE(table.find("by phase   change  matched   shift  Victor-     van\n"), std::string::npos) << ran.out;
    EXPECT_NE(table.find(" 15  0 5 9 1 0\n"), std::string::npos) << "the reference of the comparison\n" << table;
    EXPECT_NE(table.find(" 16  0 5 9 2 0      +7       14  -11.40 "), std::string::npos) << table;
    EXPECT_NE(table.find("Compared with the first row of each afferent type and channel. Spikes within 20 ms match"), std::string::npos)
        << table;
    EXPECT_EQ(table.find("fa1"), std::string::npos) << "fa1 has only one implementation\n" << table;
    const auto comparisons = Json::parse(test::read_file(folder / "answer/summary.json"))["comparisons"];
    EXPECT_EQ(comparisons["cost_Hz"], 100.0);
    ASSERT_EQ(comparisons["pairs"].size(), 1u);
    EXPECT_EQ(comparisons["pairs"][0]["afferent"], netlist);
    EXPECT_NEAR(comparisons["pairs"][0]["excess"].get<double>(), 16.0 / 15 - 1, 1e-12);
    EXPECT_EQ(run_program(folder, "respond press").out.find("Victor"), std::string::npos) << "no afferent type has two implementations";
}

TEST(Program, WritesTheRequestedFilesWithTheSameBytesTwice) {
    const TemporaryFolder folder;
    const std::string arguments = "respond press noise --seed 3 --out answer --probe-files --report";
    ASSERT_EQ(run_program(folder, arguments).status, 0);
    EXPECT_EQ(folder.file_names(),
              (std::vector<std::string>{"answer", "probes-2.csv", "probes.csv", "report.html", "spikes.csv", "summary.json"}));
    std::map<std::string, std::string> first;
    for (const auto& name : folder.file_names())
        if (name != "answer") first[name] = test::read_file(folder / ("answer/" + name));
    ASSERT_EQ(run_program(folder, arguments).status, 0);
    for (const auto& [name, bytes] : first) EXPECT_EQ(test::read_file(folder / ("answer/" + name)), bytes) << name;
    const auto summary = Json::parse(first["summary.json"]);
    EXPECT_EQ(summary["work"]["samples"], 20000);
    EXPECT_EQ(summary["afferents"][0]["parameters"]["f_B"]["value"], 20.0);
    EXPECT_EQ(summary["inputs"][1]["name"], "noise");
    EXPECT_EQ(summary["options"]["seed"], 3);
    EXPECT_EQ(summary["rates"][2]["phase"], "plateau");
    EXPECT_EQ(summary["rates"][2]["spikes"], 9);
    EXPECT_EQ(first["spikes.csv"].substr(0, 45), "afferent,channel,time_s\nsa1,press,0.319558712");
}

TEST(Program, ThreadsAndInstructionSetsChangeNoByte) {
    const TemporaryFolder folder;
    std::string wide = "t";
    for (int c = 0; c < 70; ++c) wide += ",c" + std::to_string(c) + "_N";
    for (int k = 0; k < 400; ++k) {
        wide += "\n" + std::to_string(k / 1000.0);
        for (int c = 0; c < 70; ++c) wide += "," + std::to_string((k * (c + 3) % 97) / 24.0);
    }
    folder.write("wide.csv", wide + "\n");
    for (const std::string arguments : {"respond wide.csv --afferent sa1,fa1,sa1b+izhikevich,fsr+sa1 --time t",
                                        "respond press --afferent sa1,fa1 --copies 150 --spread sa1.f_B=20% --spread fa1.V_th=10%"}) {
        ASSERT_EQ(run_program(folder, arguments + " --out expected -j 1").status, 0);
        const auto expected = test::read_file(folder / "expected/spikes.csv"), summary = test::read_file(folder / "expected/summary.json");
        EXPECT_GT(expected.size(), 2000U);
        for (const std::string set : {"scalar", "baseline", "avx2", "avx512"})
            for (const std::string threads : {"1", "2", "7"}) {
                const auto ran = std::system(("cd '" + folder.path() + "' && CORPUSCLE_ISA=" + set + " '" + test::program_path() + "' " +
                                              arguments + " --out again --quiet -j " + threads + " 2>/dev/null")
                                                 .c_str());
                if (WEXITSTATUS(ran) == 2) continue;  // this machine lacks the instruction set
                ASSERT_EQ(ran, 0);
                EXPECT_EQ(test::read_file(folder / "again/spikes.csv"), expected) << set << ' ' << threads;
                EXPECT_EQ(test::read_file(folder / "again/summary.json"), summary) << set << ' ' << threads;
            }
    }
}

TEST(Program, FloatSpikesAreWithinMicrosecondsAndHaveNoProbes) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program(folder, "respond press --out double").status, 0);
    ASSERT_EQ(run_program(folder, "respond press --float --out float --report").status, 0);
    const auto compared = run_program(folder, "compare double/spikes.csv float/spikes.csv --window 50us --json");
    const auto document = Json::parse(compared.out);
    ASSERT_EQ(document["pairs"].size(), 2U) << compared.out;
    for (const auto& pair : document["pairs"]) {
        EXPECT_EQ(pair["missing"], 0) << compared.out;
        EXPECT_EQ(pair["extra"], 0) << compared.out;
    }
    EXPECT_EQ(Json::parse(test::read_file(folder / "float/summary.json"))["options"]["precision"], "float");
    const auto with_probes = run_program(folder, "respond press --float --out float --probe-files");
    EXPECT_EQ(with_probes.status, 2);
    EXPECT_NE(with_probes.err.find("float precision cannot record probes: remove --float, or --probe and --probe-files"), std::string::npos)
        << with_probes.err;
    const auto sensor = run_program(folder, "respond press --float --afferent fsr+sa1");
    EXPECT_EQ(sensor.status, 2);
    EXPECT_NE(sensor.err.find("fsr+sa1: sensors, converters and noise cannot run in float"), std::string::npos) << sensor.err;
    EXPECT_EQ(run_program(folder, "respond press -j 99999").status, 2);
}

TEST(Program, ASecondRunRemovesTheFilesOfTheFirst) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program(folder, "respond press noise --out answer --probe-files --npz --wav --bin 10ms").status, 0);
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"answer", "probes-2.csv", "probes.csv", "psth.csv", "spikes-2.wav",
                                                             "spikes.csv", "spikes.npz", "spikes.wav", "summary.json"}));
    folder.write("answer/notes.txt", "mine");
    const auto ran = run_program(folder, "respond press --out answer --npz");
    EXPECT_NE(ran.out.find("Removed files of an earlier run: psth.csv, spikes.wav, spikes-2.wav, probes.csv, probes-2.csv\n"),
              std::string::npos)
        << ran.out;
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"answer", "notes.txt", "spikes.csv", "spikes.npz", "summary.json"}));
}

TEST(Program, CopiesGiveTheSameSpikesSummaryAndTableTwice) {
    const TemporaryFolder folder;
    const std::string arguments =
        "respond press sine --copies 60 --spread sa1.f_B=10% --spread fa1.V_th=20mV --noise 20nA --seed 3 --out answer --report";
    const auto ran = run_program(folder, arguments);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("60 copies of each afferent; mean +- standard deviation over copies that have a value\n"), std::string::npos)
        << ran.out;
    const std::vector<std::string> files = {"copies.csv", "report.html", "spikes.csv", "summary.json"};
    std::map<std::string, std::string> first;
    for (const auto& name : files) first[name] = test::read_file(folder / ("answer/" + name));
    ASSERT_EQ(run_program(folder, arguments).status, 0);
    for (const auto& [name, bytes] : first) EXPECT_EQ(test::read_file(folder / ("answer/" + name)), bytes) << name;
    const auto summary = Json::parse(first["summary.json"]);
    EXPECT_EQ(summary["copies"]["per_afferent"], 60);
    EXPECT_EQ(summary["copies"]["spreads"][0], (Json{{"afferent", "sa1"},
                                                     {"parameter", "f_B"},
                                                     {"standard_deviation", 2.0},
                                                     {"unit", "Hz"},
                                                     {"fraction", 0.1},
                                                     {"factor", nullptr}}));
    EXPECT_EQ(summary["copies"]["spreads"][1]["fraction"], nullptr);
    EXPECT_EQ(summary["afferents"].size(), 2U);
    EXPECT_EQ(summary["rates"].size(), 2U * 5 + 2);
    EXPECT_EQ(summary["rates"][2]["afferent"], "sa1");
    EXPECT_EQ(summary["rates"][2]["spikes"]["copies"], 60);
    EXPECT_GT(summary["rates"][2]["spikes"]["standard_deviation"], 0.0);
    const auto compared = Json::parse(run_program(folder, "compare answer/spikes.csv answer/spikes.csv --json").out);
    EXPECT_EQ(compared["pairs"].size(), 3U * 60) << "fa1 is silent under the sine";
    EXPECT_EQ(compared["total"]["missing"], 0);
    EXPECT_NE(run_program(folder, "respond press --out answer").out.find("Removed files of an earlier run: copies.csv, report.html\n"),
              std::string::npos);
}

TEST(Program, ASingleCopyRespondsAsTheAfferentItself) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program(folder, "respond press -a sa1,fa1-lee --noise 50nA --out plain").status, 0);
    ASSERT_EQ(run_program(folder, "respond press -a sa1,fa1-lee --noise 50nA --copies 1 --out one").status, 0);
    auto spikes = test::read_file(folder / "one/spikes.csv");
    for (std::size_t at; (at = spikes.find("#1")) != spikes.npos;) spikes.erase(at, 2);
    EXPECT_EQ(spikes, test::read_file(folder / "plain/spikes.csv"));
}

TEST(Program, ACopyIsReproducedByTheParametersInItsRow) {
    const TemporaryFolder folder;
    ASSERT_EQ(
        run_program(folder, "respond press -a sa1 --copies 9 --spread sa1.f_B=20% --spread sa1.V_th=10% --probe-files --out answer").status,
        0);
    const auto table = test::read_file(folder / "answer/copies.csv"), spikes = test::read_file(folder / "answer/spikes.csv");
    const auto row = table.substr(table.find("sa1#7,press,") + 12);
    const auto f_B = row.substr(0, row.find(',')), V_th = row.substr(f_B.size() + 1, row.find(',', f_B.size() + 1) - f_B.size() - 1);
    ASSERT_EQ(run_program(folder, "respond press -a sa1 --set sa1.f_B=" + f_B + " --set sa1.V_th=" + V_th + " --out same").status, 0);
    std::string expected = "afferent,channel,time_s\n";
    std::istringstream lines(spikes);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("sa1#7,")) expected += "sa1" + line.substr(5) + "\n";
    EXPECT_EQ(expected, test::read_file(folder / "same/spikes.csv"));
    EXPECT_NE(test::read_file(folder / "answer/probes.csv").find(",sa1#9.press.u [V]\n"), std::string::npos);
}

TEST(Program, CompareReportsTheMatchingSpikes) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program(folder, "respond press --afferent sa1,fa1,sa1-kim --npz --out a").status, 0);
    ASSERT_EQ(run_program(folder, "respond press --set sa1.f_B=20.1Hz --out b").status, 0);
    const auto same = Json::parse(run_program(folder, "compare a/spikes.npz a/spikes.csv --json").out);
    EXPECT_EQ(same["total"]["spikes_a"], 39);
    EXPECT_EQ(same["total"]["matched"], 39);
    EXPECT_LE(same["total"]["max_shift_s"], 0.51e-9) << "CSV is rounded to the nanosecond";
    const auto text = run_program(folder, "compare a/spikes.csv b/spikes.csv");
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("sa1-kim,press  -          16   0        0       16      0      -      -    16.00"), std::string::npos)
        << text.out;
    EXPECT_NE(text.out.find("Matching window 5 ms; Victor-Purpura cost 100 per second; van Rossum time constant 10 ms."),
              std::string::npos);
    const auto two = Json::parse(run_program(folder, "compare a/spikes.csv --pair sa1=sa1-kim --window 1s --json").out);
    EXPECT_EQ(two["pairs"].size(), 1U);
    EXPECT_EQ(two["pairs"][0]["b"], "sa1-kim,press");
    EXPECT_EQ(two["total"]["extra"], 1);
    const auto other = run_program(folder, "compare a/spikes.csv b/spikes.csv --pair sa1=sa2");
    EXPECT_EQ(other.status, 2);
    EXPECT_EQ(other.err, "corpuscle: --pair sa1=sa2: the second file has no train 'sa2'; it has fa1,press; sa1,press\n");
}

TEST(Program, CompareReadsTheSpikesOfTheElectronicSkin) {
    const auto motor = test::shared_file_path("fbg_eskin_press/motor_spikes_S6_T16.csv"),
               snn = test::shared_file_path("fbg_eskin_press/snn_spikes_S6_T16.csv");
    CORPUSCLE_NEEDS(motor);
    const TemporaryFolder folder;
    const auto itself = Json::parse(run_program(folder, "compare '" + motor + "' '" + motor + "' --json").out);
    EXPECT_EQ(itself["total"]["matched"], 1305);
    EXPECT_EQ(itself["total"]["victor_purpura"], 0.0);
    const auto other = run_program(folder, "compare '" + motor + "' '" + snn + "'");
    EXPECT_EQ(other.status, 2);
    EXPECT_NE(other.err.find("no train has the same name in both files: 6; 11; 16 | 243; "), std::string::npos) << other.err;
}

TEST(Program, AReportWithoutOutIsWrittenToTheGivenOrCurrentFolder) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_program(folder, "respond press --report").status, 0);
    EXPECT_EQ(run_program(folder, "respond --report press").status, 0) << "the argument after --report is not a page, so it is a force";
    EXPECT_EQ(run_program(folder, "respond press --report sub/touch.html").status, 0);
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"report.html", "sub", "touch.html"}));
    const auto page = test::read_file(folder / "report.html");
    EXPECT_EQ(page.find("{{title}}"), std::string::npos);
    EXPECT_NE(page.find("<title>press</title>"), std::string::npos);
    EXPECT_NE(page.find("getContext"), std::string::npos);
}

TEST(Program, JsonOutputIsASingleDocument) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press --json --set sa1.f_B=25Hz --set press.F_max=2N");
    ASSERT_EQ(ran.status, 0);
    const auto document = Json::parse(ran.out);
    EXPECT_EQ(document["afferents"][0]["parameters"]["f_B"], (Json{{"value", 25.0}, {"unit", "Hz"}, {"component", "sa1b"}, {"set", true}}));
    const auto listed = Json::parse(run_program(folder, "list --json").out);
    EXPECT_EQ(listed["afferents"].size(), named_afferents().size() + std::size(circuit::embedded_netlists) + 2)
        << "one entry stands for all netlist files, and one for all NIR files";
    for (const auto& entry : receptor_entries())
        EXPECT_TRUE(std::any_of(listed["receptors"].begin(), listed["receptors"].end(), [&](const Json& e) {
            return e["name"] == entry.name;
        })) << entry.name;
    EXPECT_EQ(run_program(folder, "respond press --json --quiet").out, run_program(folder, "respond press --json").out);
}

TEST(Program, ListNamesEveryParameterOfEveryModel) {
    const TemporaryFolder folder;
    const auto text = run_program(folder, "list").out;
    for (const auto& entries :
         {sensor_entries(), transducer_entries(), converter_entries(), receptor_entries(), neuron_entries(), stimulus_catalog()})
        for (const auto& entry : entries) {
            EXPECT_NE(text.find("  " + std::string(entry.name) + ": "), std::string::npos) << entry.name;
            for (const auto& row : entry.parameters)
                EXPECT_NE(text.find(std::string(row.description)), std::string::npos) << entry.name << '.' << row.name;
            for (const auto& row : entry.parameters)
                EXPECT_NE(text.find("\n    " + std::string(row.name) + " "), std::string::npos)
                    << entry.name << '.' << row.name << " is not indented";
        }
    EXPECT_EQ(run_program(folder, "list neuron").err, "corpuscle: list: there is no 'neuron'; did you mean 'neurons'?\n");
    EXPECT_NE(run_program(folder, "list sa1 press").out.find("half-cosine"), std::string::npos);
}

TEST(Program, BadInputAndBadUsageHaveTheirStatusAndMessageAndLeaveNoFiles) {
    const TemporaryFolder folder;
    folder.write("bad.csv", "time_s,fz_N\n0,1\n0.01,2\n0.02,oops\n");
    folder.write("nm.csv", "time_s,a_nm\n0,1\n0.01,2\n");
    const struct {
        const char* arguments;
        int status;
        const char* message;
    } cases[] = {
        {"respond bad.csv --out answer", 1,
         "bad.csv:4:6: column 'fz': 'oops' where a number is expected; use --bad-fields interpolate to fill it in, or --bad-fields "
         "drop to skip the row"},
        {"respond nm.csv --out answer", 1,
         "nm.csv: 'a' is in nm, which is not a force; use --scale S for S newtons per nm, --unit N if the header is wrong, "
         "or --channel to select another column"},
        {"respond none.csv", 1, "none.csv: cannot be opened: No such file or directory"},
        {"respond pres", 1, "unknown stimulus 'pres'; did you mean 'press'? (and no file 'pres' exists)"},
        {"respond press -a sa9", 1,
         "unknown afferent 'sa9'; did you mean 'sa1'? ('corpuscle list' shows them all; a receptor and a neuron are combined as "
         "'sa1b+lif-b')"},
        {"respond press --set sa1.f_B=25ms", 1, "sa1.f_B: '25ms' is a time; expected a value in Hz, such as '2 Hz'"},
        {"respond press --set fa2.k=1", 2,
         "--set fa2.k=1: nothing here is named 'fa2'; did you mean 'fa1'? (parameters of sa1, fa1, press can be set)"},
        {"respond press --set f_B=1", 2, "--set 'f_B=1' is not a setting; write NAME.PARAMETER=VALUE, such as 'sa1.f_B=25Hz'"},
        {"respond press --rate fast", 2, "--rate 'fast' is not a quantity; write a number and a unit, such as '2 Hz'"},
        {"respond press --probe-files", 2, "--probe-files needs --out DIR"},
        {"respond press --vectors", 2, "--vectors needs --out DIR"},
        {"respond press --vectors --out answer", 2,
         "--vectors: sa1 has no converter, and so no fixed-point values; try --afferent adc+sa1"},
        {"respond press --afferent sa1-circuit --vectors --out answer", 2,
         "--vectors: sa1-circuit has no converter, and so no fixed-point values; try --afferent sa1-kim"},
        {"respond press --noise -1nA", 2, "--noise '-1nA' is negative; write a standard deviation, such as '50 nA'"},
        {"respond press -a sa1 -a SA1", 2, "--afferent SA1: sa1 is given twice"},
        {"respond", 2, "respond: no FORCE given; try 'corpuscle respond press'"},
        {"respond press --spread sa1.f_B=10%", 2, "--spread sa1.f_B=10% needs --copies N, such as --copies 100"},
        {"respond press --copies 9 --spread f_B=10%", 2,
         "--spread 'f_B=10%': write NAME.PARAMETER=SPREAD, such as 'sa1.f_B=10%' or 'sa1.f_B=x1.5'"},
        {"respond press --copies 9 --spread fa2.k=10%", 2,
         "--spread fa2.k=10%: nothing here is named 'fa2'; did you mean 'fa1'? (parameters of sa1, fa1 can be set)"},
        {"respond press --copies 9 --spread fa1.I_leak0=10ms", 1,
         "--spread fa1.I_leak0=10ms: '10ms' is a time; expected a value in A, such as '2 A'"},
        {"respond press --copies 51 --probe-files --out answer", 2,
         "--probe-files works with at most 50 copies, not 51; use fewer, or simulate one copy: --set its values from copies.csv"},
        {"respond press --copies 51 --vectors --out answer -a sa1-kim", 2,
         "--vectors works with at most 50 copies, not 51; use fewer, or simulate one copy: --set its values from copies.csv"},
        {"respond press --copies 30000 --wav --out answer --set press.t_hold=0s", 1,
         "'press': 60000 afferents at once would make each click too soft for 16 bits; run it without --wav"},
        {"respond press --set press.F_max=2N press.t_up=5ms", 2,
         "press.t_up=5ms: neither a stimulus nor a file; each setting needs its own option: --set press.t_up=5ms"},
        {"respond press --scale 2", 2, "--scale is for recordings, but press is a stimulus; change it by --set press.PARAMETER=VALUE"},
        {"respond press --wav", 2, "--wav needs --out DIR"},
        {"respond press --bin 0s --out answer", 2, "--bin 0s: must be greater than 0, such as 10ms"},
        {"respond press --bin 5Hz --out answer", 2, "--bin '5Hz' is a frequency; expected a value in s, such as '2 s'"},
        {"compare", 2, "compare: no files given; try 'corpuscle compare A/spikes.csv B/spikes.csv'"},
        {"compare bad.csv", 2, "compare bad.csv: needs a second file, or two trains of this file: --pair sa1=fa1"},
        {"compare bad.csv none.csv", 1,
         "bad.csv:1: no column identifies the trains; rename one to unit, afferent or channel, or select it with --train. "
         "Columns: 'time_s', 'fz_N'"},
        {"compare nm.csv none.csv --window 0s", 2, "--window 0s: must be greater than 0"},
        {"compare bad.csv none.csv --cost=-1", 2, "--cost -1: must be 0 or more"},
        {"respond press --out bad.csv", 1, "bad.csv: the directory cannot be created: Not a directory"},
    };
    for (const auto& c : cases) {
        const auto ran = run_program(folder, c.arguments);
        EXPECT_EQ(ran.status, c.status) << c.arguments;
        EXPECT_EQ(ran.err, "corpuscle: " + std::string(c.message) + "\n") << c.arguments;
        EXPECT_EQ(ran.out, "") << c.arguments;
    }
    EXPECT_EQ(run_program(folder, "respond press --sampeld").status, 2);
    for (const auto* n : {"0", "-1", "1000001", "ten"})
        EXPECT_EQ(run_program(folder, "respond press --copies " + std::string(n)).status, 2) << n;
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"bad.csv", "nm.csv"}));
}

TEST(Program, StudiesAreListedWrittenAndSelectedByAnyOfTheirNumbers) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "study fig4 table17 eq30 --json --report page.html --markdown numbers.md");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto document = Json::parse(ran.out);
    std::vector<std::string> names;
    for (const auto& study : document["studies"]) names.push_back(study["name"]);
    EXPECT_EQ(names, (std::vector<std::string>{"fig4", "table17-18", "eq21-30"}));
    const auto& fig4 = document["studies"][0];
    EXPECT_EQ(fig4["claims"][0]["published"], 0.2);
    EXPECT_EQ(fig4["claims"][0]["kind"], "input");
    EXPECT_FALSE(fig4["plots"][0]["series"][0]["x"].empty());
    EXPECT_EQ(document["kinds"][0]["kind"], "predicted");
    EXPECT_GT(document["kinds"][0]["printed"]["agreeing"], 0) << "of table 17";
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"numbers.md", "page.html"}));
    EXPECT_NE(test::read_file(folder / "numbers.md").find("## table17-18"), std::string::npos);
    const auto unknown = run_program(folder, "study fig7 --report other.html");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("study: unknown study 'fig7'"), std::string::npos) << unknown.err;
    EXPECT_EQ(run_program(folder, "study table19").status, 2);
    EXPECT_EQ(folder.file_names().size(), 2u);
    EXPECT_NE(run_program(folder, "study fig4 --quiet --report numbers.md/page.html").status, 0) << "a file cannot contain a page";
}

TEST(Program, AStudyWithoutItsProgramIsAnErrorThatSaysHowToBuildIt) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(test::program_path(), folder / "corpuscle");
    const auto command = "cd '" + folder.path() + "' && ./corpuscle study fig4 2>message";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_EQ(test::read_file(folder / "message"), "corpuscle: study: the program corpuscle-study is not in " +
                                                       std::filesystem::canonical(folder.path()).string() +
                                                       "; 'make reproduction' in the clone builds it\n");
}

TEST(Program, NamesMayContainAnyBytes) {
    const TemporaryFolder folder;
    folder.write("l.csv",
                 "t,Gr\xf6\xdf"  // Latin-1
                 "e_N\n0,1\n0.01,2\n0.02,2\n");
    const auto ran = run_program(folder, "respond l.csv --out answer --report --json");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_FALSE(Json::parse(ran.out).is_discarded());
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"answer", "l.csv", "report.html", "spikes.csv", "summary.json"}));
}

TEST(Program, AStimulusTakesPrecedenceOverADirectoryOfItsName) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_program(folder, "respond press --out press --quiet").status, 0);
    EXPECT_EQ(run_program(folder, "respond press --out press --quiet").status, 0);
}

TEST(Program, AFullOutputDeviceAndATooLongNameAreErrors) {
    const TemporaryFolder folder;
    const auto full = std::system(("'" + test::program_path() + "' list >/dev/full 2>'" + (folder / "err") + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(full), 1);
    EXPECT_EQ(run_program(folder, "respond " + std::string(5000, 'x')).status, 1) << "longer than a file name can be";
}

TEST(Program, ANonFiniteStateIsReported) {
    const TemporaryFolder folder;
    const auto ran = run_program(
        folder, "respond press -a sa1b+adex --set sa1b+adex.g_L=1mS --out answer --npz --bin 1ms");  // far too stiff for its substep
    EXPECT_EQ(ran.status, 3);
    EXPECT_NE(ran.err.find("sa1b+adex on press: sa1b+adex: its state became NaN or infinite"), std::string::npos) << ran.err;
    EXPECT_TRUE(folder.file_names().empty());
}

TEST(Program, AliasesAreAcceptedWhereverNamesAre) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_program(folder, "list FA-I").out, run_program(folder, "list fa1").out);
    const auto by_alias = Json::parse(run_program(folder, "respond press -a fa1 --set FA-I.f=3Hz --json").out);
    EXPECT_EQ(by_alias["afferents"][0]["parameters"]["f"]["value"], 3.0);
}

TEST(Program, SummaryDescribesTheRun) {
    const TemporaryFolder folder;
    const auto ran = Json::parse(run_program(folder, "respond press --set press.F_max=2N --json").out);
    EXPECT_EQ(ran["inputs"][0]["parameters"]["press.F_max"], (Json{{"value", 2.0}, {"unit", "N"}}));
    EXPECT_EQ(ran["inputs"][0]["force_max_N"], 2.0);
    folder.write("x.csv", "t,a,a\n0,1,2\n0.01,3,4\n");
    const auto read = Json::parse(run_program(folder, "respond x.csv --scale 0.5 --json").out);
    EXPECT_EQ(read["inputs"][0]["parameters"]["a: newtons per unit"]["value"], 0.5);
    EXPECT_EQ(read["inputs"][0]["channels"], (Json{"a", "a (2)"})) << "two columns of the same name are two channels";
}

TEST(Program, ProgressWithTimeLeftIsPrintedToTerminalsOnly) {
    if (!test::has_pseudo_terminals()) GTEST_SKIP() << test::no_pseudo_terminals;
    const TemporaryFolder folder;
    const std::string job = "respond sine --set sine.duration=400s --afferent sa1b+adex";  // long enough for progress to be printed
    const auto terminal_file = folder / "terminal";
    ASSERT_EQ(
        std::system(
            ("script -qec \"'" + test::program_path() + "' " + job + "\" /dev/null > '" + terminal_file + "' 2>&1 < /dev/null").c_str()),
        0);
    const auto terminal_output = test::read_file(terminal_file);
    EXPECT_NE(terminal_output.find(" s left"), std::string::npos) << terminal_output.substr(0, 400);
    EXPECT_NE(terminal_output.find(" %  "), std::string::npos);
    EXPECT_EQ(run_program(folder, job).err, "") << "not a terminal";
}

TEST(Program, SaturationOverflowAndNoiseWithoutEffectAreReported) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        run_program(folder, "respond press -q -a fsr+f2v+sa1 --set press.F_max=8N").err,
        "corpuscle: warning: 3335 samples saturated a transducer or a converter, so the afferent received less force than was applied; "
        "lower R_fb or V_FSR, raise V_DD or I_max, or widen F_low to F_high\n");
    EXPECT_NE(run_program(folder, "respond press -q -a sa1-kim --set sa1-kim.frac=28 --set sa1-kim.k_s=10e-6")
                  .err.find("results overflowed their words"),
              std::string::npos);
    EXPECT_EQ(run_program(folder, "respond press -q -a sa1-kim --noise 1nA").err,
              "corpuscle: warning: sa1-kim: --noise has no effect; behind a converter the membrane is digital\n");
    const auto noisy = Json::parse(run_program(folder, "respond press --noise 200nA --seed 5 --json").out);
    EXPECT_DOUBLE_EQ(noisy["options"]["noise_A"].get<double>(), 200e-9);
    EXPECT_EQ(noisy["work"]["saturated"], 0);
}

TEST(Program, ReadsFromAPipe) {
    const TemporaryFolder folder;
    folder.write("x.csv", "1\n2\n3\n");
    EXPECT_EQ(std::system(("cat '" + (folder / "x.csv") + "' | '" + test::program_path() + "' respond - --rate 100Hz --quiet").c_str()), 0);
}

TEST(Program, HelpAndVersionAreComplete) {
    const TemporaryFolder folder;
    EXPECT_NE(run_program(folder, "--help").out.find("corpuscle respond press"), std::string::npos);
    const auto help = run_program(folder, "respond --help");
    EXPECT_EQ(help.status, 0);
    for (const auto& entry : stimulus_catalog()) EXPECT_NE(help.out.find(std::string(entry.name)), std::string::npos) << entry.name;
    for (const auto& a : named_afferents()) EXPECT_NE(help.out.find(std::string(a.name)), std::string::npos) << a.name;
    EXPECT_EQ(run_program(folder, "--version").out.rfind("corpuscle ", 0), 0U);
}

TEST(Program, CtrlCAndOtherSignalsEndItCleanly) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const TemporaryFolder folder;
        const auto answer = folder / "new/deep/answer";
        const pid_t child = test::fork_child();
        if (child == 0) {
            if (!std::freopen("/dev/null", "w", stderr)) std::_Exit(98);
            ::execl(test::program_path().c_str(), "corpuscle", "respond", "sine", "--set", "sine.duration=100000s", "--rate", "100kHz",
                    "--out", answer.c_str(), nullptr);
            std::_Exit(99);
        }
        for (int k = 0; k < 200 && !std::filesystem::exists(answer + "/summary.json.part-" + std::to_string(child)); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        EXPECT_TRUE(std::filesystem::exists(answer)) << "the run has begun";
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        test::signal_child(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 130);
        EXPECT_TRUE(folder.file_names().empty()) << "no partial file is left";
    }
}

TEST(Program, APressOnTheElectronicSkinIsReadWithARateInsteadOfItsTimes) {
    const auto path = test::shared_file_path("fbg_eskin_press/fbg_press_S6_T16.csv");
    CORPUSCLE_NEEDS(path);
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond '" + path + "' --rate 100Hz --scale 40 --out touch --report");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("were replaced by an even clock of 100 Hz"), std::string::npos) << ran.err;
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"report.html", "spikes.csv", "summary.json", "touch"}));
}

}  // namespace
}  // namespace corpuscle
