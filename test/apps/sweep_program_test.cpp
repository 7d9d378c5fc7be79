// corpuscle sweep as users run it: in one process, in shards, interrupted, and on MPI ranks that are killed.

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "support/child_process.hpp"
#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;
using Json = nlohmann::json;
using test::run_program;

/// A sweep of the SA-I model, with `items` items at each of two forces.
std::string sweep_of(int items) {
    return "afferent = \"sa1\"\nsamples = " + std::to_string(items) +
           "\nmeasures = [\"spikes\", \"first_spike\"]\n[[vary]]\nwhat = \"press.F_max\"\nlist = [\"1N\", \"2N\"]\n"
           "[[vary]]\nwhat = \"f_B\"\nsigma = \"5%\"\n";
}

/// The text of all results. Compare it with ==: EXPECT_EQ would look for the shortest edit between two texts of megabytes, which takes
/// 24 GB of memory.
std::string dump(const TemporaryFolder& folder, const std::string& results) {
    const auto ran = run_program(folder, "sweep dump " + results);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.out;
}

TEST(SweepProgram, RenamedOptionsAreRefusedWithTheirNewNames) {
    const TemporaryFolder folder;
    for (const std::string arguments : {"sweep a.toml --units 3", "sweep a.toml --units=3", "sweep calibrate sa1-circuit --units 3"}) {
        const auto ran = run_program(folder, arguments);
        EXPECT_EQ(ran.status, 2) << arguments;
        EXPECT_NE(ran.err.find("--units is now --samples"), std::string::npos) << ran.err;
    }
    EXPECT_NE(run_program(folder, "sweep calibrate sa1-circuit --apart").err.find("--apart is now --separately"), std::string::npos);
}

TEST(SweepProgram, CalibrateTakesSettingsAndTheTimeOfTheFirstSpike) {
    const TemporaryFolder folder;
    const auto calibrated = [&](const std::string& options) {
        const auto ran = run_program(folder, "sweep calibrate fa1-circuit --samples 2 --bits 1 --json " + options);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return Json::parse(ran.out);
    };
    const auto standard = calibrated("--set hv_membrane=0 --first-spike 20ms"), high = calibrated("--first-spike 20ms");
    EXPECT_EQ(standard["settings"], (Json{"corner=mc", "hv_membrane=0"}));
    EXPECT_NE(standard["limits"].get<std::string>().find("344.5 ms +- 20 ms"), std::string::npos) << standard["limits"];
    EXPECT_NE(standard["sets"][0]["chips"][0]["spikes_before"], high["sets"][0]["chips"][0]["spikes_before"]);
    EXPECT_EQ(high["sets"][0]["within_limits"][0], 2);
    EXPECT_EQ(calibrated("--first-spike 1us")["sets"][0]["within_limits"][0], 0);
    for (const auto& [options, message] : {std::pair("--set hv_membran=0", "did you mean 'hv_membrane'"),
                                           {"--set hv_membrane", "--set hv_membrane: write NAME=VALUE"},
                                           {"--first-spike 0ms", "--first-spike"},
                                           {"--first-spike 3N", "--first-spike"}}) {
        const auto ran = run_program(folder, std::string("sweep calibrate fa1-circuit --samples 1 ") + options);
        EXPECT_NE(ran.status, 0) << options;
        EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    }
}

TEST(SweepProgram, ReportsItsProgressAndResumesWhereItStopped) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(50));
    EXPECT_NE(run_program(folder, "sweep a.toml --status").err.find("a.sqlite: does not exist"), std::string::npos);
    ASSERT_EQ(run_program(folder, "sweep a.toml --shard 1/4 -o a.sqlite --quiet").status, 0);
    const auto status = Json::parse(run_program(folder, "sweep a.toml --status --json").out);
    EXPECT_EQ(status["finished"], 25);
    EXPECT_EQ(status["missing"], 75);
    const auto of_next_shard = Json::parse(run_program(folder, "sweep a.toml --shard 2/4 -o a.sqlite --status --json").out);
    EXPECT_EQ(of_next_shard["finished"], 0);
    EXPECT_EQ(of_next_shard["missing"], 25);
    const auto ran = run_program(folder, "sweep a.toml -j 2");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("  100    100        75        0        100          0         0"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("corpuscle sweep show a.sqlite"), std::string::npos);
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"a.sqlite", "a.toml"}));
    ASSERT_EQ(run_program(folder, "sweep a.toml -j 1 --lanes 1 -o b.sqlite").status, 0);
    EXPECT_TRUE(dump(folder, "a.sqlite") == dump(folder, "b.sqlite"));
    for (const std::string k : {"1", "2", "3"}) ASSERT_EQ(run_program(folder, "sweep a.toml --shard " + k + "/3").status, 0);
    EXPECT_NE(run_program(folder, "sweep merge c.sqlite a-1of3.sqlite a-3of3.sqlite a-2of3.sqlite")
                  .out.find("a-3of3.sqlite: 33 items, 33 of them new"),
              std::string::npos);
    EXPECT_TRUE(dump(folder, "a.sqlite") == dump(folder, "c.sqlite"));
    const auto other = run_program(folder, "sweep a.toml --seed 7");
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("a.sqlite: holds results of another sweep: sweep file"), std::string::npos) << other.err;
    EXPECT_EQ(run_program(folder, "sweep a.toml --shard 4/3").status, 2);
    EXPECT_EQ(run_program(folder, "sweep").status, 2);
}

TEST(SweepProgram, AChangedRecordingIsAnotherSweep) {
    const TemporaryFolder folder;
    folder.write("a.toml",
                 "afferent = \"sa1\"\nforce = \"r.csv\"\nsamples = 2\nmeasures = [\"spikes\"]\n[[vary]]\nwhat = \"f_B\"\nsigma = \"5%\"\n");
    folder.write("r.csv", "time_s,fz_N\n0,2\n0.1,0.5\n0.2,0\n0.3,2\n");
    ASSERT_EQ(run_program(folder, "sweep a.toml --quiet").status, 0);
    ASSERT_EQ(run_program(folder, "sweep a.toml --quiet").status, 0);
    folder.write("r.csv", "time_s,fz_N\n0,2\n0.1,0.5\n0.2,2\n0.3,0\n");  // the low bits of all these numbers are 0
    const auto ran = run_program(folder, "sweep a.toml --quiet");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("holds results of another sweep"), std::string::npos) << ran.err;
}

TEST(SweepProgram, AnInterruptedSweepKeepsTheFinishedItems) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(500'000));
    const auto command =
        "cd '" + folder.path() + "' && timeout -s INT 1 '" + test::program_path() + "' sweep a.toml --quiet 2>err; echo $? >status";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_NE(test::read_file(folder / "err").find("items have ended and are saved in a.sqlite; the same command resumes the sweep"),
              std::string::npos)
        << test::read_file(folder / "err");
    const auto status = Json::parse(run_program(folder, "sweep a.toml --status --json").out);
    EXPECT_GT(status["finished"], 0);
    EXPECT_GT(status["missing"], 0);
    EXPECT_FALSE(status.contains("writer"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.sqlite-wal")) << "the results are in one file";
}

TEST(SweepProgram, RepeatedSignalsInterruptLikeOneSignal) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(500'000));
    const auto pid = test::fork_child();
    if (pid == 0) {
        ::setenv("PROGRAM", test::program_path().c_str(), 1), ::setenv("FOLDER", folder.path().c_str(), 1);
        ::execl("/bin/sh", "sh", "-c", "cd \"$FOLDER\" && exec \"$PROGRAM\" sweep a.toml --quiet 2>err", nullptr);
        ::_exit(127);
    }
    const auto pause = [](int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); };
    for (int k = 0; k < 2000 && !std::filesystem::exists(folder / "a.sqlite-wal"); ++k) pause(5);
    pause(300);
    for (int k = 0; k < 5; ++k) test::signal_child(pid, SIGINT), pause(5);  // signals closer together would be delivered as one
    int status = 0;
    ASSERT_EQ(::waitpid(pid, &status, 0), pid);
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_NE(test::read_file(folder / "err").find("items have ended and are saved in a.sqlite"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.sqlite-wal"));
}

struct RanRanks {
    int status;
    std::string output;
};

struct RankOptions {
    std::string arguments = {};  // of the sweep
    std::string mpirun = {};     // options of mpirun
    int victim = -1;             // the rank that is killed once the results have rows; -1: none
};

/// Runs the sweep `file` under mpirun, with results in `out`. Rank k expands $OMPI_COMM_WORLD_RANK in the name of the file to k.
RanRanks run_ranks(const TemporaryFolder& folder, int ranks, const std::string& file, const std::string& out,
                   const RankOptions& options = {}) {
    folder.write("rank.sh", "if [ \"$OMPI_COMM_WORLD_RANK\" = " + std::to_string(options.victim) + " ]; then (until [ \"$(stat -c %s " +
                                out + "-wal 2>/dev/null || echo 0)\" -gt 50000 ]; do sleep 0.02; done; kill -9 $$) & fi\nexec '" +
                                test::program_path() + "' sweep " + file + " --quiet -o " + out + " " + options.arguments + "\n");
    const std::string root = ::geteuid() == 0 ? "--allow-run-as-root " : "";
    const auto command = "cd '" + folder.path() + "' && timeout 60 mpirun " + root + "--oversubscribe " + options.mpirun + " -n " +
                         std::to_string(ranks) + " sh rank.sh >log 2>&1";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), test::read_file(folder / "log")};
}

/// The first number of the version.
int open_mpi_version() {
    std::FILE* pipe = popen("mpirun --version", "r");
    std::string text(100, '\0');  // "mpirun (Open MPI) 4.1.4"
    text.resize(std::fread(text.data(), 1, text.size(), pipe));
    pclose(pipe);
    return std::stoi(text.substr(text.find(") ") + 2));
}

TEST(SweepRanks, GiveTheResultsOfOneThread) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(300));
    ASSERT_EQ(run_program(folder, "sweep a.toml -j 1 -o alone").status, 0);
    const auto one_thread = dump(folder, "alone");
    for (const int ranks : {1, 2, 3, 4}) {
        const auto out = "r" + std::to_string(ranks);
        const auto ran = run_ranks(folder, ranks, "a.toml", out);
        ASSERT_EQ(ran.status, 0) << ran.output;
        EXPECT_TRUE(dump(folder, out) == one_thread) << ranks;
    }
}

// mpirun then ends all ranks.
TEST(SweepRanks, AfterAKilledRankTheSameCommandComputesOnlyWhatIsMissing) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(30'000));
    ASSERT_EQ(run_program(folder, "sweep a.toml -o alone").status, 0);
    const auto one_thread = dump(folder, "alone");
    for (const int victim : {0, 2}) {
        const auto out = "r" + std::to_string(victim);
        const auto ran = run_ranks(folder, 3, "a.toml", out, {.victim = victim});
        EXPECT_NE(ran.status, 0) << ran.output;
        EXPECT_NE(ran.output.find("run noticed that process rank " + std::to_string(victim)), std::string::npos) << ran.output;
        if (victim > 0) {
            EXPECT_NE(ran.output.find("the same command resumes the sweep"), std::string::npos) << ran.output;
        }
        const auto ended = Json::parse(run_program(folder, "sweep a.toml --status --json -o " + out).out)["finished"].get<int>();
        EXPECT_GT(ended, 0);
        const auto resumed = run_ranks(folder, 2, "a.toml", out);
        EXPECT_EQ(resumed.status, 0) << resumed.output;
        const auto rest = Json::parse(run_program(folder, "sweep a.toml --json -o " + out).out);
        EXPECT_EQ(rest["missing"], 0);
        EXPECT_EQ(rest["this_run"], 0);
        EXPECT_TRUE(dump(folder, out) == one_thread) << victim;
    }
}

TEST(SweepRanks, ComputeOneShardTogether) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(300));
    ASSERT_EQ(run_program(folder, "sweep a.toml -o alone").status, 0);
    for (const std::string k : {"1/2", "2/2"})
        ASSERT_EQ(run_ranks(folder, 2, "a.toml", "s" + k.substr(0, 1), {.arguments = "--shard " + k}).status, 0);
    const auto merged = run_program(folder, "sweep merge both s1 s2");
    EXPECT_NE(merged.out.find("s1: 300 items, 300 of them new"), std::string::npos) << merged.out;
    EXPECT_TRUE(dump(folder, "both") == dump(folder, "alone"));
}

TEST(SweepRanks, EndWithTheErrorOfAnyOfThemAndItsExitStatus) {
    const TemporaryFolder folder;
    folder.write("0.toml", sweep_of(300));
    const auto missing = run_ranks(folder, 2, "$OMPI_COMM_WORLD_RANK.toml", "r");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.output.find(": 1.toml: cannot be read"), std::string::npos) << missing.output;
    EXPECT_NE(missing.output.find("corpuscle: rank 1 on "), std::string::npos) << missing.output;
    folder.write("1.toml", sweep_of(301));
    const auto other = run_ranks(folder, 2, "$OMPI_COMM_WORLD_RANK.toml", "r");
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.output.find("reads another sweep than rank 0: give all ranks the same files"), std::string::npos) << other.output;
    const auto none = run_ranks(folder, 2, "none.toml", "r");
    EXPECT_EQ(none.status, 1);
    EXPECT_EQ(none.output.find("none.toml"), none.output.rfind("none.toml")) << "printed once\n" << none.output;
}

TEST(SweepRanks, AreRefusedIfADeadOneWouldLeaveThemWaiting) {
    if (open_mpi_version() >= 5) GTEST_SKIP() << "Open MPI 5 does not tell its ranks of --enable-recovery";
    const TemporaryFolder folder;
    folder.write("0.toml", sweep_of(300));
    const auto recovery = run_ranks(folder, 2, "0.toml", "r", {.mpirun = "--enable-recovery"});
    EXPECT_NE(recovery.output.find("leave the option out"), std::string::npos) << recovery.output;
}

}  // namespace
}  // namespace corpuscle
