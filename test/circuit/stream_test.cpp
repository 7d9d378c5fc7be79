// Output of long transients: files that can be read at any time, however the program ends; constant memory.

#include <gtest/gtest.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "support/child_process.hpp"
#include "support/ngspice.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit::test {
using namespace corpuscle::test;
namespace {

/// Runs for minutes unless it is stopped.
constexpr const char* endless_deck =
    "long\nv1 in 0 sin(0 1 1k)\nr1 in out 1k\nc1 out 0 1u\n.save v(out) v(in,out)\n.tran 10u 10000 0 10u\n";

std::string rc(double stop) { return fmt::format("rc\nv1 in 0 sin(0 1 1k)\nr1 in out 1k\nc1 out 0 1u\n.tran 10u {:g} 0 10u\n", stop); }

/// A running instance of the program in a folder.
class Running {
    pid_t id_;

public:
    Running(const TemporaryFolder& folder, std::vector<std::string> words) {
        id_ = fork_child();
        if (id_ != 0) return;
        words.insert(words.begin(), program_path());
        std::vector<char*> arguments;
        for (auto& w : words) arguments.push_back(w.data());
        arguments.push_back(nullptr);
        const int err = open((folder / ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), out = open("/dev/null", O_WRONLY);
        if (chdir(folder.path().c_str()) != 0 || dup2(err, 2) < 0 || dup2(out, 1) < 0) _exit(99);
        execv(arguments[0], arguments.data());
        _exit(99);
    }
    /// Sends a signal (0: none), waits, and returns the wait status and the resources used.
    int end(int signal, struct rusage* used = nullptr) {
        if (signal != 0) signal_child(id_, signal);
        int status = 0;
        struct rusage unused{};
        wait4(id_, &status, 0, used ? used : &unused);
        return status;
    }
};

/// Waits until a file has at least this many bytes; false after 5 s.
bool wait_for_file(const std::string& path, std::uintmax_t bytes = 1) {
    for (int k = 0; k < 1000; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
        std::error_code none;
        if (const auto size = std::filesystem::file_size(path, none); !none && size >= bytes) return true;
    }
    return false;
}

/// Expects points of `endless_deck` in the order of time.
void expect_valid(const Plot& plot, std::size_t at_least) {
    ASSERT_EQ(plot.curves.size(), 3U);
    EXPECT_EQ(plot.curves[2].name, "v(in,out)");
    ASSERT_GE(plot.point_count(), at_least);
    double before = -1;
    for (std::size_t k = 0; k < plot.point_count(); ++k) {
        const double t = plot.curves[0].values[k].real(), out = plot.curves[1].values[k].real(), drop = plot.curves[2].values[k].real();
        ASSERT_GT(t, before) << k;
        ASSERT_LE(t, 10000);
        ASSERT_NEAR(out + drop, std::sin(2 * M_PI * 1e3 * t), 1e-4) << k;
        before = t;
    }
}

/// Expects rows of `endless_deck`; the last line may be incomplete.
void expect_rows(const std::string& text) {
    std::istringstream lines(text.substr(0, text.rfind('\n') + 1));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "time,v(out),\"v(in,out)\"");
    while (std::getline(lines, line)) {
        double t = 0, out = 0, drop = 0;
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &out, &drop), 3) << line;
        ASSERT_NEAR(out + drop, std::sin(2 * M_PI * 1e3 * t), 1e-4) << line;
    }
}

TEST(Stream, AKilledRunLeavesAFileThatIsReadableToItsLastBlock) {
    std::mt19937 random(7);
    for (int k = 0; k < 20; ++k) {
        SCOPED_TRACE(k);
        const TemporaryFolder folder;
        folder.write("x.cir", endless_deck);
        const bool ascii = k % 4 == 3, table = k % 4 == 1;
        const std::string name = table ? "x.csv" : "x.raw";
        std::vector<std::string> words{"run", "x.cir", "-o", name};
        if (ascii) words.emplace_back("--ascii");
        Running run(folder, words);
        ASSERT_TRUE(wait_for_file(folder / (name + ".part"), 60'000)) << read_file(folder / ".err");
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 100'000));
        run.end(SIGKILL);
        EXPECT_FALSE(std::filesystem::exists(folder / name));
        const auto text = read_file(folder / (name + ".part"));
        if (table) {
            expect_rows(text);
            continue;
        }
        const auto plots = read_raw(text);
        ASSERT_EQ(plots.size(), 1U);
        expect_valid(plots[0], 0);
        const auto values = text.find(ascii ? "Values:\n" : "Binary:\n");
        ASSERT_NE(values, text.npos);
        const auto lines = std::count(text.begin() + static_cast<std::ptrdiff_t>(values) + 8, text.end(), '\n');
        const auto written = ascii ? static_cast<std::size_t>(lines) / 3 : (text.size() - values) / 24;  // points of three numbers
        EXPECT_GE(plots[0].point_count() + 100'000 / (ascii ? 75 : 24), written) << "at most one block is missing";
    }
}

/// A limit of the file size acts like a full disk.
TEST(Stream, AFileThatCannotGrowEndsEarly) {
    for (const std::string name : {"x.raw", "x.csv"}) {
        const TemporaryFolder folder;
        folder.write("x.cir", endless_deck);
        const auto line =
            fmt::format("cd '{}' && trap '' XFSZ && ulimit -f 1000 && '{}' run x.cir -o {} 2>.err", folder.path(), program_path(), name);
        EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 1);
        const auto err = read_file(folder / ".err");
        EXPECT_NE(err.find(name + ": could not be written completely: File too large"), std::string::npos) << err;
        EXPECT_NE(err.find(name + " ends early, at "), std::string::npos) << err;
        const auto text = read_file(folder / name);
        EXPECT_GT(text.size(), 400'000U);
        name == "x.csv" ? expect_rows(text) : expect_valid(read_raw(text)[0], 10'000);
    }
}

TEST(Stream, TheNextRunReplacesTheFileOfAKilledRun) {
    const TemporaryFolder folder;
    folder.write("x.cir", endless_deck);
    folder.write("short.cir", rc(1e-3));
    Running killed(folder, {"run", "x.cir", "-o", "x.raw"});
    ASSERT_TRUE(wait_for_file(folder / "x.raw.part", 60'000));
    killed.end(SIGKILL);
    EXPECT_EQ(run_program(folder, "run short.cir -o x.raw").status, 0);
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"short.cir", "x.cir", "x.raw"}));
    EXPECT_NEAR(read_raw_file(folder / "x.raw")[0].curves[0].values.back().real(), 1e-3, 1e-15);
}

TEST(Stream, ASecondRunDoesNotWriteTheSameFile) {
    const TemporaryFolder folder;
    folder.write("x.cir", endless_deck);
    folder.write("short.cir", rc(1e-3));
    Running first(folder, {"run", "x.cir", "-o", "x.raw"});
    ASSERT_TRUE(wait_for_file(folder / "x.raw.part", 60'000));
    const auto second = run_program(folder, "run short.cir -o x.raw");
    EXPECT_EQ(second.status, 1);
    EXPECT_NE(second.err.find("x.raw: another program is writing this file"), std::string::npos) << second.err;
    first.end(SIGINT);
    expect_valid(read_raw_file(folder / "x.raw")[0], 1000);
}

TEST(Stream, AnInterruptedRunLeavesItsFileUnderItsNameAndReportsTheEarlyEnd) {
    for (const std::string name : {"x.raw", "x.csv"}) {
        const TemporaryFolder folder;
        folder.write("x.cir", endless_deck);
        Running run(folder, {"run", "x.cir", "-o", name});
        ASSERT_TRUE(wait_for_file(folder / (name + ".part"), 60'000));
        const int status = run.end(SIGINT);
        ASSERT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 130);
        EXPECT_NE(read_file(folder / ".err").find("warning: " + name + " ends early, at "), std::string::npos)
            << read_file(folder / ".err");
        EXPECT_FALSE(std::filesystem::exists(folder / (name + ".part")));
        if (name == "x.raw") expect_valid(read_raw_file(folder / name)[0], 1000);
        const auto text = read_file(folder / name);
        if (name == "x.csv") {
            EXPECT_TRUE(text.starts_with("time,v(out),\"v(in,out)\"\n0,"));
            EXPECT_EQ(text.back(), '\n');
        }
    }
}

/// dv/dt = -1e12 (v^2 + 1 - c): c falls below 1 after 1 ms, and v then goes to minus infinity immediately.
TEST(Stream, ARunThatDoesNotConvergeKeepsItsPoints) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\nv1 c 0 pwl(0 2 2m 0)\nr1 c 0 1\nb1 a 0 i=(v(a)*v(a)+1-v(c))*1e3\nc1 a 0 1n\n.nodeset v(a)=1\n.tran 1u 2m\n");
    const auto ran = run_program(folder, "run x.cir -o x.raw");
    EXPECT_EQ(ran.status, 3) << ran.err;
    EXPECT_NE(ran.err.find("x.raw ends early, at 1"), std::string::npos) << ran.err;
    ASSERT_TRUE(std::filesystem::exists(folder / "x.raw"));
    EXPECT_NEAR(read_raw_file(folder / "x.raw")[0].curves[0].values.back().real(), 1e-3, 1e-4);
}

TEST(Stream, MemoryDoesNotGrowWithTime) {
    const auto max_memory = [](double stop, const std::string& out) {
        const TemporaryFolder folder;
        folder.write("x.cir", rc(stop) + ".meas tran n count v(out)=0 rise\n.meas tran e rms v(out)\n");
        Running run(folder, out.empty() ? std::vector<std::string>{"run", "x.cir"} : std::vector<std::string>{"run", "x.cir", "-o", out});
        struct rusage used{};
        EXPECT_EQ(run.end(0, &used), 0);
        return used.ru_maxrss;  // kB
    };
    for (const std::string out : {"", "x.raw", "x.csv"}) {
        const auto few = max_memory(0.1, out), many = max_memory(4, out);  // 400,000 points, of 5 curves: 32 MB as complex numbers
        EXPECT_LT(many, few + 2000) << out;
    }
}

TEST(Stream, StreamedPointsEqualThoseInMemory) {
    const TemporaryFolder folder;
    folder.write("x.cir", rc(20e-3) + ".op\n.save v(out) i(v1)\n");
    EXPECT_EQ(run_program(folder, "run x.cir -o x.raw").status, 0);
    EXPECT_EQ(run_program(folder, "run x.cir -o y.raw --ascii").status, 0);
    EXPECT_EQ(run_program(folder, "run x.cir -o x.csv").status, 0);
    const auto document = nlohmann::json::parse(run_program(folder, "run x.cir --json").out);
    const auto binary = read_raw_file(folder / "x.raw"), ascii_plots = read_raw_file(folder / "y.raw");
    const auto reference = run_corpuscle(folder / "x.cir").plots();
    ASSERT_EQ(binary.size(), 2U);
    ASSERT_EQ(ascii_plots.size(), 2U);
    ASSERT_EQ(reference.size(), 2U);
    for (std::size_t p = 0; p < 2; ++p) {
        EXPECT_EQ(binary[p].name, reference[p].name);
        ASSERT_EQ(binary[p].point_count(), reference[p].point_count());
        for (std::size_t c = 0; c < reference[p].curves.size(); ++c) {
            const auto& curve = reference[p].curves[c];
            EXPECT_EQ(binary[p].curves[c].name, curve.name);
            for (std::size_t k = 0; k < reference[p].point_count(); ++k) {
                EXPECT_EQ(binary[p].curves[c].values[k], curve.values[k]);
                EXPECT_NEAR(ascii_plots[p].curves[c].values[k].real(), curve.values[k].real(), 1e-15 * std::abs(curve.values[k].real()));
                EXPECT_EQ(document["plots"][p]["curves"][curve.name][k].get<double>(), curve.values[k].real());
            }
        }
    }
    const auto table = read_file(folder / "x-1.csv");
    EXPECT_TRUE(table.starts_with("time,v(out),i(v1)\n0,0,"));
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), static_cast<long>(reference[0].point_count()) + 1);
}

TEST(Stream, StepsFollowEachOtherInOneTable) {
    const TemporaryFolder folder;
    folder.write("x.cir", rc(1e-4) + ".step param q list 1 2\n.param q=1\n");
    EXPECT_EQ(run_program(folder, "run x.cir -o x.csv").status, 0);
    EXPECT_EQ(run_program(folder, "run x.cir -o x.raw").status, 0);
    const auto table = read_file(folder / "x.csv");
    EXPECT_TRUE(table.starts_with("step,time,v(in),v(out),i(v1)\nq=1,0,")) << table.substr(0, 100);
    EXPECT_NE(table.find("\nq=2,0,"), std::string::npos);
    const auto plots = read_raw_file(folder / "x.raw");
    ASSERT_EQ(plots.size(), 2U);
    EXPECT_EQ(plots[1].name, "Transient Analysis (q=2)");
}

TEST(Stream, NgspiceReadsTheFileOfAKilledRun) {
    const TemporaryFolder folder;
    folder.write("x.cir", endless_deck);
    Running killed(folder, {"run", "x.cir", "-o", "x.raw"});
    ASSERT_TRUE(wait_for_file(folder / "x.raw.part", 200'000));
    killed.end(SIGKILL);
    const auto points = read_raw_file(folder / "x.raw.part")[0].point_count();
    const auto head = read_file(folder / "x.raw.part").find("Binary:\n") + 8;
    std::filesystem::resize_file(folder / "x.raw.part", head + points * 24);  // as if the run had ended after a block
    const auto deck =
        folder.write("load.cir", "load\n.control\nload " + (folder / "x.raw.part") + "\nprint length(time)\nquit\n.endc\n.end\n");
    const auto log = run_ngspice(deck, "");
    EXPECT_EQ(logged_number(log, "length(time)"), static_cast<double>(points)) << log;
}

/// A run that is killed after it wrote the points of a block, but before their count, leaves such bytes.
TEST(Stream, BytesAfterTheCountedPointsAreIgnored) {
    const TemporaryFolder folder;
    folder.write("x.cir", rc(1e-3));
    EXPECT_EQ(run_program(folder, "run x.cir -o x.raw").status, 0);
    const auto complete = read_file(folder / "x.raw");
    const auto points = read_raw(complete)[0].point_count();
    folder.write("y.raw", complete + complete.substr(complete.size() - 1003));
    EXPECT_EQ(read_raw_file(folder / "y.raw")[0].point_count(), points);
}

TEST(Stream, PrintsARowPerStepOfTran) {
    const TemporaryFolder folder;
    const std::string text = "t\nv1 a 0 pwl(0 0 1m 1 3m 0)\nr1 a 0 1\n.print tran v(a)\n.print tran i(v1)\n";
    folder.write("x.cir", text + ".tran 0.5m 2m\n");
    folder.write("z.cir", text + ".tran 0.5m 2m 0.75m\n");
    const auto out = run_program(folder, "run x.cir").out, later = run_program(folder, "run z.cir").out;
    EXPECT_NE(out.find("            time            v(a)\n   0.0000000e+00   0.0000000e+00\n   5.0000000e-04   5.0000000e-01\n"
                       "   1.0000000e-03   1.0000000e+00\n   1.5000000e-03   7.5000000e-01\n   2.0000000e-03   5.0000000e-01\n"
                       "            time           i(v1)\n"),
              std::string::npos)
        << out;
    EXPECT_NE(later.find("            time            v(a)\n   1.2500000e-03   8.7500000e-01\n   1.7500000e-03   6.2500000e-01\n  "),
              std::string::npos)
        << later;
    folder.write("y.cir", "t\nv1 a 0 1\nr1 a 0 1\n.tran 1n 1\n.print tran v(a)\n");
    const auto refused = run_program(folder, "run y.cir");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("y.cir:5:1: .print tran: 1e+09 rows"), std::string::npos) << refused.err;
}

TEST(Stream, TheJsonReportsTheRunStatistics) {
    const TemporaryFolder folder;
    folder.write("x.cir", rc(1e-3) + ".op\n");
    const auto plain = nlohmann::json::parse(run_program(folder, "run x.cir --json").out);
    ASSERT_EQ(plain["analyses"].size(), 2U);
    const auto& tran = plain["analyses"][0];
    EXPECT_EQ(tran["analysis"], "tran");
    EXPECT_GE(tran["points"].get<long>(), tran["steps"].get<long>() + 1);
    EXPECT_GE(tran["iterations"].get<long>(), tran["steps"].get<long>());
    EXPECT_GE(tran["rejected"].get<long>(), 0);
    EXPECT_EQ(plain["plots"].size(), 2U);
    const auto written = nlohmann::json::parse(run_program(folder, "run x.cir --json -o x.raw").out);
    EXPECT_EQ(written["analyses"], plain["analyses"]);
    EXPECT_EQ(written["plots"].size(), 1U) << "the curves of the transient are in the file";
}

/// Uses a pseudo-terminal.
TEST(Stream, ATerminalShowsHowMuchTimeIsLeft) {
    const TemporaryFolder folder;
    folder.write("x.cir", std::string(endless_deck) + ".op\n");
    int terminal = -1;
    const pid_t id = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (id < 0) GTEST_SKIP() << no_pseudo_terminals;
    if (id == 0) {
        if (chdir(folder.path().c_str()) != 0) _exit(99);
        execl(program_path().c_str(), "corpuscle", "run", "x.cir", "-o", "x.raw", nullptr);
        _exit(99);
    }
    std::string shown;
    char buffer[4096];
    for (ssize_t n = 0; shown.find(" left") == std::string::npos && (n = read(terminal, buffer, sizeof buffer)) > 0;)
        shown.append(buffer, static_cast<std::size_t>(n));
    signal_child(id, SIGINT);
    while (read(terminal, buffer, sizeof buffer) > 0) {
    }
    int status = 0;
    waitpid(id, &status, 0);
    close(terminal);
    EXPECT_NE(shown.find(" %  "), std::string::npos) << shown;
    EXPECT_NE(shown.find(" left"), std::string::npos) << shown;
}

}  // namespace
}  // namespace corpuscle::circuit::test
