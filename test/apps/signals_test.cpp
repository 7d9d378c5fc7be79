// Signals: which processes receive them, and what they end.

#include <sys/stat.h>
#include <filesystem>
#include <fstream>

#include "support/child_process.hpp"
#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// Lines of our sources that signal a process, as file:text.
std::vector<std::string> lines_that_signal() {
    std::vector<std::string> out;
    for (const char* folder_name : {"src", "apps", "test", "bench", "examples"})
        for (const auto& entry : fs::recursive_directory_iterator(test::source_root() + "/" + folder_name)) {
            const auto path = entry.path().string();
            if (!entry.is_regular_file() || !(path.ends_with(".cpp") || path.ends_with(".hpp") || path.ends_with(".py"))) continue;
            std::ifstream in(path);
            for (std::string line; std::getline(in, line);)
                for (const std::string call : {" kill(", "::kill(", "(kill(", "killpg(", "os.kill", "sigqueue("})
                    if (line.find(call) != line.npos && line.find("\"") == line.npos) {
                        out.push_back(path.substr(test::source_root().size() + 1) + ":" + line);
                        break;
                    }
        }
    return out;
}

/// If fork() or forkpty() fails, its result -1 must not be signalled: kill with -1 reaches every process of the machine.
TEST(Signals, AreSentOnlyAfterACheckThatTheProcessWasStarted) {
    const std::map<std::string, std::string> checked = {
        {"src/io/sandbox/helper_process.cpp", "after a check that child > 0"},
        {"test/support/child_process.hpp", "contains the check and its comment"},
    };
    for (const auto& line : lines_that_signal()) EXPECT_TRUE(checked.contains(line.substr(0, line.find(':')))) << line;
}

TEST(Signals, AProcessThatWasNotStartedIsNeverSignalled) {
    EXPECT_FALSE(test::signal_child(-1, 0));
    EXPECT_FALSE(test::signal_child(0, 0));
    EXPECT_FALSE(test::signal_child(-::getpid(), 0));
    EXPECT_TRUE(test::signal_child(::getpid(), 0));
}

/// The wait status of a command that receives `signal` after 0.3 s. Its standard input is an open pipe without data.
int status_after(int signal, const TemporaryFolder& folder, std::vector<std::string> command) {
    int silent_pipe[2];
    if (::pipe2(silent_pipe, O_CLOEXEC) != 0) return -1;
    const pid_t child = test::fork_child();
    if (child == 0) {
        command.insert(command.begin(), test::program_path());
        std::vector<char*> arguments;
        for (auto& w : command) arguments.push_back(w.data());
        arguments.push_back(nullptr);
        ::dup2(silent_pipe[0], 0);
        if (::chdir(folder.path().c_str()) == 0 && std::freopen(".err", "w", stderr)) ::execv(arguments[0], arguments.data());
        std::_Exit(99);
    }
    ::close(silent_pipe[0]);
    ::usleep(300'000);
    test::signal_child(child, signal);
    int status = -1;
    for (int k = 0; k < 300 && ::waitpid(child, &status, WNOHANG) == 0; ++k) ::usleep(10'000);
    if (status == -1) test::signal_child(child, SIGKILL), ::waitpid(child, nullptr, 0);
    ::close(silent_pipe[1]);
    return status;
}

TEST(Signals, EndAReadThatWaitsForInput) {
    const TemporaryFolder folder;
    for (const auto* const name : {"fifo", "fifo.toml"}) ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    const std::vector<std::vector<std::string>> commands = {
        {"respond", "-", "--rate", "1kHz", "-o", "new"},
        {"respond", "fifo", "--rate", "1kHz", "-o", "new"},  // no process writes to it
        {"run", "fifo"},
        {"respond", "press", "--population", "fifo.toml", "-o", "new"},
        {"compare", "fifo", "fifo"},
        {"sweep", "fifo.toml", "-o", "new"},
    };
    for (const auto& command : commands)
        for (const int signal : {SIGINT, SIGTERM}) {
            const int status = status_after(signal, folder, command);
            ASSERT_TRUE(WIFEXITED(status)) << command[0] << ' ' << command[1] << ", signal " << signal << ", status " << status;
            EXPECT_EQ(WEXITSTATUS(status), 130) << test::read_file(folder / ".err");
            EXPECT_FALSE(fs::exists(folder / "new"));
        }
}

// A comparator that chatters takes steps of nanoseconds, so one block of force takes minutes.
TEST(Signals, EndACircuitThatIsSimulatedSlowly) {
    const TemporaryFolder folder;
    const std::string circuit =
        "chatter\niin 0 m dc 0 force 5u\nrm m 0 1meg\ncm m 0 100p\n"
        "ecomp g 0 table {v(m)-0.7} = (-1,0) (-0.001,0) (0.001,5) (1,5)\nrg g 0 10k\n"
        "s1 m 0 g 0 sw\n.model sw sw(ron=1k roff=1g vt=2.5 vh=0.5)\n.ic v(m)=0\n.spike v(g) 2.5\n";
    folder.write("slow.cir", circuit + ".end\n");
    folder.write("mc.cir", circuit + ".param r={agauss(1k,1,1)}\nrx m 0 {1e9+r}\n.mc 2\n.end\n");
    folder.write("slow.toml", "afferent = \"slow.cir\"\nforce = \"press\"\n[[vary]]\nwhat = \"temp\"\nlist = [27, 30]\n");
    const std::vector<std::vector<std::string>> commands = {
        {"respond", "press", "--afferent", "slow.cir", "-o", "new"},
        {"respond", "press", "press", "--afferent", "slow.cir,sa1", "--threads", "2", "--report", "new.html"},
        {"respond", "press", "--afferent", "mc.cir", "--copies", "2", "--json"},
        {"sweep", "slow.toml", "-o", "results"},
    };
    for (const auto& command : commands)
        for (const int signal : {SIGINT, SIGTERM}) {
            const int status = status_after(signal, folder, command);
            ASSERT_TRUE(WIFEXITED(status)) << command[0] << ' ' << command[1] << ", signal " << signal << ", status " << status;
            EXPECT_EQ(WEXITSTATUS(status), 130) << test::read_file(folder / ".err");
            EXPECT_NE(test::read_file(folder / ".err").find("corpuscle: interrupted"), std::string::npos);
            EXPECT_FALSE(fs::exists(folder / "new") || fs::exists(folder / "new.html"));
        }
}

}  // namespace
}  // namespace corpuscle
