// The verb 'fit afferent' of the program.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;

const std::string data = test::source_root() + "/examples/data/";
const std::string quick = " --points 20 --starts 2 --evaluations 60 ";

TEST(FitProgram, FitsTheExample) {
    const TemporaryFolder folder;
    const auto ran = run_program(
        folder, fmt::format("fit afferent {0}touch.csv --spikes {0}touch_spikes.csv --free k_A,K_B,f_B --json -o fitted.toml", data));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    const auto document = nlohmann::json::parse(ran.out);
    const double expected[] = {1.5e-6, 5e-6, 12};  // as examples/data/README.md says
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& p = document["parameters"][k];
        EXPECT_LE(p["low"].get<double>(), expected[k]) << p;
        EXPECT_GE(p["high"].get<double>(), expected[k]) << p;
    }
    // The file is a sweep file, and may be replaced by the next fit.
    EXPECT_EQ(run_program(folder, "sweep fitted.toml --out fitted.sqlite").status, 0);
    EXPECT_EQ(run_program(folder, fmt::format("fit afferent {0}touch.csv --spikes {0}touch_spikes.csv --free k_A -o fitted.toml -q{1}",
                                              data, quick))
                  .status,
              0);
    folder.write("mine.toml", "afferent = \"sa1\"\n");
    EXPECT_EQ(run_program(folder,
                          fmt::format("fit afferent {0}touch.csv --spikes {0}touch_spikes.csv --free k_A -o mine.toml -q{1}", data, quick))
                  .status,
              1);
}

TEST(FitProgram, PrintsOptionsThatCanBePasted) {
    const TemporaryFolder folder;
    const auto ran = run_program(
        folder, fmt::format("fit afferent {0}touch.csv --spikes {0}touch_spikes.csv --free k_A --hold-out 0.3{1}", data, quick));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto at = ran.out.find("--afferent sa1 --set sa1.k_A=");
    ASSERT_NE(at, std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("held out"), std::string::npos);
    const auto options = ran.out.substr(at, ran.out.find('\n', at) - at);
    EXPECT_EQ(run_program(folder, "respond press " + options).status, 0) << options;
}

TEST(FitProgram, ReadsMillisecondsWithTheHeaderThatTheErrorNames) {
    const TemporaryFolder folder;
    folder.write("ms.csv", "time_ms\n500\n512\n530\n");
    EXPECT_EQ(run_program(folder, fmt::format("fit afferent {}touch.csv --spikes ms.csv --free k_A -q{}", data, quick)).status, 0);
}

TEST(FitProgram, WritesTheCommandWithItsFolders) {
    const TemporaryFolder folder;
    ASSERT_EQ(
        run_program(folder, fmt::format("fit afferent {0}touch.csv --spikes {0}touch_spikes.csv --free k_A -o f.toml -q{1}", data, quick))
            .status,
        0);
    const auto text = test::read_file(folder / "f.toml");
    EXPECT_NE(text.find("corpuscle fit afferent " + data + "touch.csv"), std::string::npos) << text;
}

TEST(FitProgram, RefusesWhatCannotBeFitted) {
    const TemporaryFolder folder;
    folder.write("empty.csv", "");
    folder.write("none.csv", "afferent,channel,time_s\n");
    folder.write("late.csv", "time_s\n1000\n1001\n");
    folder.write("ms.csv", "500\n512\n530\n");
    folder.write("two.csv", "unit,time_s\n1,0.5\n2,0.6\n");
    const auto touch = data + "touch.csv ";
    const std::pair<std::string, std::string> rows[] = {
        {"fit", "name what to fit: corpuscle fit afferent"},
        {"fit afferent " + touch + "--spikes two.csv", "--free is required"},
        {"fit afferent " + touch + "--free k_A", "no data"},
        {"fit afferent " + touch + "--spikes empty.csv --free k_A", "empty.csv"},
        {"fit afferent " + touch + "--spikes none.csv --free k_A", "none.csv"},
        {"fit afferent " + touch + "--spikes late.csv --free k_A",
         "late.csv: no spike lies in the time of touch: the spikes are from 1000 s to 1001 s, the force from 0 s to "},
        {"fit afferent " + touch + "--spikes ms.csv --free k_A", "write the header time_ms above their column"},
        {"fit afferent " + touch + "--spikes ms.csv --free k_A --delay 12", "write --delay 12ms if milliseconds are meant"},
        {"fit afferents " + touch + "--spikes ms.csv --free k_A", "fit: unknown verb 'afferents'; did you mean 'afferent'?"},
        {"fit afferent " + touch + "--spikes two.csv --free k_A", "--train NAME: 1, 2"},
        {"fit afferent " + touch + "--spikes two.csv --train 3 --free k_A", "has no such train; it has 1, 2"},
        {"fit afferent " + touch + touch + "--spikes two.csv --free k_A", "one --spikes FILE for each FORCE"},
        {"fit afferent press --spikes two.csv --train 1 --free k_B", "did you mean"},
        {"fit afferent press --spikes two.csv --train 1 --free k_A --afferent sa1-circuit", "corpuscle sweep calibrate sa1-circuit"},
        {"fit afferent press --spikes two.csv --train 1 --free k_A --set fa1.k_A=1u", "fa1.k_A"},
        {"fit afferent press --spikes two.csv --train 1 --free k_A --hold-out 2", "--hold-out 2"}};
    for (const auto& [arguments, message] : rows) {
        const auto ran = run_program(folder, arguments);
        EXPECT_TRUE(ran.status == 1 || ran.status == 2) << arguments << ": " << ran.status;
        EXPECT_NE(ran.err.find(message), std::string::npos) << arguments << "\n" << ran.err;
    }
}

}  // namespace
}  // namespace corpuscle
