// corpuscle optimize as users run it.

#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::json;
using test::run_program;
using test::TemporaryFolder;

constexpr const char* loaded_divider = "divider\n.param r=10k\nvin in 0 1\nr1 in out {r}\nrl out 0 100k\n.op\n.end\n";
std::string problem(const std::string& limit) {
    return "netlist = \"divider.cir\"\n[[variable]]\nwhat = \"r\"\nfrom = \"1kohm\"\nto = \"1Mohm\"\nlog = true\n"
           "[goal]\nmaximize = \"i(vin)\"\n[limits]\n\"v(out)\" = {at_least = \"" +
           limit + "\"}\n[search]\npoints = 4\nstarts = 1\n";
}

struct OptimizeProgram : testing::Test {
    TemporaryFolder folder;
    OptimizeProgram() {
        folder.write("divider.cir", loaded_divider);
        folder.write("o.toml", problem("0.8V"));
    }
};

TEST_F(OptimizeProgram, WritesANetlistThatRuns) {
    const auto ran = run_program(folder, "optimize o.toml");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out.find("Written: o.cir, o.sqlite"), std::string::npos) << ran.out;
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"divider.cir", "o.cir", "o.sqlite", "o.toml"}));
    const auto found = run_program(folder, "run o.cir --json");
    ASSERT_EQ(found.status, 0) << found.err;
    EXPECT_NE(found.out.find("v(out)"), std::string::npos) << found.out;
    // Its own file may be replaced, and the same command gives the same text.
    const auto text = test::read_file(folder / "o.cir");
    ASSERT_EQ(run_program(folder, "optimize o.toml --quiet").status, 0);
    EXPECT_EQ(test::read_file(folder / "o.cir"), text);
}

TEST_F(OptimizeProgram, PrintsOneDocument) {
    const auto ran = run_program(folder, "optimize o.toml --json -j 2");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto document = Json::parse(ran.out);
    EXPECT_NEAR(document["variables"][0]["found"].get<double>(), 25e3, 100);
    EXPECT_EQ(document["variables"][0]["unit"], "ohm");
    EXPECT_EQ(document["found"]["is_within"], true);
    EXPECT_EQ(document["limits"].size(), 1U);
}

TEST_F(OptimizeProgram, WritesNoNetlistIfTheLimitsCannotBeMet) {
    folder.write("o.toml", problem("0.999V"));
    const auto ran = run_program(folder, "optimize o.toml --quiet");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("o.toml: no design within the limits was found; the best one fails"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("v(out) at least 999 mV"), std::string::npos) << ran.err;
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"divider.cir", "o.sqlite", "o.toml"}));
}

TEST_F(OptimizeProgram, WrongFilesWriteNothing) {
    folder.write(
        "o.toml",
        "netlist = \"divider.cir\"\n[[variable]]\nwhat = \"r\"\nfrom = \"1Mohm\"\nto = \"1kohm\"\n[goal]\nmaximize = \"i(vin)\"\n");
    const auto ran = run_program(folder, "optimize o.toml");
    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.err, "corpuscle: o.toml:4:8: r: the bounds cross: from = 1Mohm is above to = 1kohm; exchange them\n");
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"divider.cir", "o.toml"}));
}

TEST_F(OptimizeProgram, ReplacesNeitherItsInputNorAForeignFile) {
    EXPECT_EQ(run_program(folder, "optimize o.toml --netlist divider.cir --overwrite").status, 2);
    EXPECT_EQ(test::read_file(folder / "divider.cir"), loaded_divider);
    folder.write("o.cir", "my own netlist\n.end\n");
    const auto ran = run_program(folder, "optimize o.toml");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("o.cir"), std::string::npos);
    EXPECT_NE(ran.err.find("--overwrite"), std::string::npos) << ran.err;
    EXPECT_EQ(test::read_file(folder / "o.cir"), "my own netlist\n.end\n");
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"divider.cir", "o.cir", "o.toml"}));
}

TEST_F(OptimizeProgram, RefusesTheResultsOfAnotherFile) {
    ASSERT_EQ(run_program(folder, "optimize o.toml --quiet").status, 0);
    folder.write("o.toml", problem("0.7V"));
    const auto ran = run_program(folder, "optimize o.toml --quiet");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("o.sqlite: holds results of another"), std::string::npos) << ran.err;
    EXPECT_EQ(run_program(folder, "optimize o.toml --quiet --out other.sqlite").status, 0);
}

TEST_F(OptimizeProgram, AnInterruptedSearchResumes) {
    folder.write("m.toml",
                 "afferent = \"sa1-circuit\"\n[[variable]]\nwhat = \"i_biasf\"\nfrom = \"300nA\"\nto = \"1uA\"\n"
                 "[goal]\nminimize = \"power\"\n[search]\npoints = 4\nstarts = 1\nevaluations = 5\nrounds = 1\n");
    const auto stopped = run_program(folder, "optimize m.toml & sleep 0.4 && kill -TERM $! && wait $!");
    if (stopped.status == 0) GTEST_SKIP() << "the search ended before the signal";
    EXPECT_EQ(stopped.status, 130) << stopped.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "m.cir"));
    const auto resumed = run_program(folder, "optimize m.toml --json"),
               complete = run_program(folder, "optimize m.toml --json -o c.sqlite");
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(resumed.out, complete.out);
}

}  // namespace
}  // namespace corpuscle
