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

TEST(SweepProgram, ReportsItsProgressAndResumesWhereItStopped) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(50));
    EXPECT_NE(run_program(folder, "sweep a.toml --status").err.find("a.sqlite: does not exist"), std::string::npos);
    ASSERT_EQ(run_program(folder, "sweep a.toml --shard 1/4 -o a.sqlite --quiet").status, 0);
    const auto status = Json::parse(run_program(folder, "sweep a.toml --status --json").out);
    EXPECT_EQ(status["finished"], 25);
    EXPECT_EQ(status["missing"], 75);
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

/// Runs the sweep under mpirun. Rank `victim` (-1: none) is killed once the file `out` has rows.
RanRanks run_ranks(const TemporaryFolder& folder, int ranks, const std::string& out, const std::string& options = "", int victim = -1) {
    folder.write("rank.sh", "if [ \"$OMPI_COMM_WORLD_RANK\" = " + std::to_string(victim) + " ]; then (until [ \"$(stat -c %s " + out +
                                "-wal 2>/dev/null || echo 0)\" -gt 50000 ]; do sleep 0.02; done; kill -9 $$) & fi\nexec '" +
                                test::program_path() + "' sweep a.toml --quiet -o " + out + "\n");
    const std::string root = ::geteuid() == 0 ? "--allow-run-as-root " : "";
    const auto command = "cd '" + folder.path() + "' && timeout 60 mpirun " + root + "--oversubscribe " + options + " -n " +
                         std::to_string(ranks) + " sh rank.sh >log 2>&1";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), test::read_file(folder / "log")};
}

TEST(SweepRanks, GiveTheResultsOfOneThread) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(300));
    ASSERT_EQ(run_program(folder, "sweep a.toml -j 1 -o alone").status, 0);
    const auto one_thread = dump(folder, "alone");
    for (const int ranks : {1, 2, 3, 4}) {
        const auto out = "r" + std::to_string(ranks);
        const auto ran = run_ranks(folder, ranks, out);
        ASSERT_EQ(ran.status, 0) << ran.output;
        EXPECT_TRUE(dump(folder, out) == one_thread) << ranks;
    }
}

TEST(SweepRanks, AKilledRankLosesOnlyItsBlock) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(30'000));
    ASSERT_EQ(run_program(folder, "sweep a.toml -o alone").status, 0);
    const auto one_thread = dump(folder, "alone");
    const auto ran = run_ranks(folder, 3, "r", "--enable-recovery", 1);
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("1 rank died or stopped responding, and "), std::string::npos) << ran.output;
    EXPECT_TRUE(dump(folder, "r") == one_thread) << "this run computed all items";
    // Without rank 0 the other ranks end, and the same command resumes the sweep.
    const auto without_rank_0 = run_ranks(folder, 3, "h", "--enable-recovery", 0);
    EXPECT_NE(without_rank_0.output.find("rank 0, which writes the results, has died; results so far are kept"), std::string::npos)
        << without_rank_0.output;
    ASSERT_EQ(run_program(folder, "sweep a.toml -o h").status, 0);
    EXPECT_TRUE(dump(folder, "h") == one_thread);
}

TEST(SweepRanks, WithoutRecoveryNoFinishedItemIsLost) {
    const TemporaryFolder folder;
    folder.write("a.toml", sweep_of(30'000));
    const auto ran = run_ranks(folder, 3, "r", "", 2);
    EXPECT_NE(ran.status, 0) << "mpirun ends all ranks\n" << ran.output;
    const auto ended = Json::parse(run_program(folder, "sweep a.toml -o r --status --json").out)["finished"].get<int>();
    EXPECT_GT(ended, 0);
    const auto rest = Json::parse(run_program(folder, "sweep a.toml -o r --json").out);
    EXPECT_EQ(rest["this_run"], 60'000 - ended);
    EXPECT_EQ(rest["missing"], 0);
}

}  // namespace
}  // namespace corpuscle
