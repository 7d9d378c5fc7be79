// Which files the program may replace: none that it reads, and none that it did not write.

#include <fcntl.h>
#include <linux/fiemap.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/output/output_check.hpp"
#include "io/output/output_file.hpp"
#include "support/child_process.hpp"
#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::TemporaryFolder;

const char* const small_deck = "small\nv1 in 0 1\nr1 in out 1k\nr2 out 0 1k\n.op\n.tran 10u 1m\n";

std::string recording_text() {
    std::string text = "t_s,fz_N\n";
    for (int k = 0; k < 300; ++k) text += fmt::format("{},{}\n", 0.001 * k, k % 100 < 50 ? 0 : 2);
    return text;
}

/// Every file below a folder, with its bytes.
std::map<std::string, std::string> contents(const TemporaryFolder& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file()) all[entry.path().string().substr(folder.path().size() + 1)] = read_file(entry.path().string());
    return all;
}

TEST(Outputs, NeverReplaceAFileThatTheCommandReads) {
    const TemporaryFolder folder;
    folder.write("a.cir", std::string(small_deck) + ".include part-1.csv\n");
    folder.write("part-1.csv", "* nothing\n");
    folder.write("f.csv", recording_text());
    for (const char* name : {"psth.csv", "spikes.csv", "probes.csv", "afferents.csv", "page.html"}) folder.write(name, recording_text());
    folder.write("layout.html", "channel,name,x_mm,y_mm\n1,a,0,0\n");
    fs::create_symlink("f.csv", folder / "link.csv");
    fs::create_hard_link(folder / "f.csv", folder / "hard.csv");
    ASSERT_EQ(test::run_program(folder, "stream --in press --pace fast -o /dev/null --save-state s.state -q").status, 0);
    const auto before = contents(folder);
    for (const std::string arguments : {
             "respond psth.csv --bin 10ms -o .",
             "respond spikes.csv -o .",
             "respond probes.csv --probe-files -o .",
             "respond spikes.csv -o . --overwrite",
             "respond afferents.csv --population 'grid 1x1' -o .",
             "respond page.html --report page.html",
             "respond page.html --report page.html --overwrite",
             "respond f.csv --layout layout.html --report layout.html",
             "respond - --report page.html < page.html",
             "run a.cir -o part.csv",
             "export a.cir -o a.cir",
             "export a.cir -o part-1.csv --overwrite",
             "stream --in f.csv --pace fast -o f.csv",
             "stream --in f.csv --pace fast -o link.csv --overwrite",
             "stream --in f.csv --pace fast -o hard.csv --overwrite",
             "stream --in f.csv --pace fast -o x.csv --save-state f.csv --overwrite",
             "stream --in press --pace fast -o s.state --resume s.state --overwrite",
             "stream --rate 1kHz -o f.csv --overwrite < f.csv",
         }) {
        const auto ran = test::run_program(folder, arguments);
        EXPECT_EQ(ran.status, 2) << arguments << '\n' << ran.err;
        EXPECT_NE(ran.err.find("this output would replace an input of the command"), std::string::npos) << arguments << '\n' << ran.err;
        EXPECT_EQ(contents(folder), before) << arguments;
    }
    EXPECT_EQ(test::run_program(folder, "stream --in press --pace fast -o /dev/null --resume s.state --save-state s.state -q").status, 0)
        << "the state that is resumed may be replaced";
}

TEST(Outputs, ReplaceAFileThatNoEarlierRunWroteOnlyWithTheOption) {
    struct Case {
        const char *file, *arguments;
    };
    for (const auto& c :
         {Case{"own/spikes.csv", "respond press -o own"}, Case{"own/summary.json", "respond press -o own"},
          Case{"own/afferents.csv", "respond press --population 'grid 4x4' -o own"},
          Case{"own/report.html", "respond press -o own --report"}, Case{"x.html", "respond press --report x.html"},
          Case{"x-1.csv", "run a.cir -o x.csv"}, Case{"x-2.csv", "run a.cir -o x.csv"}, Case{"x.raw", "run a.cir -o x.raw"},
          Case{"x.raw.part", "run a.cir -o x.raw"}, Case{"x.cir", "export a.cir -o x.cir"},
          Case{"x.csv", "stream --in press --pace fast -o x.csv"}, Case{"x.csv.part", "stream --in press --pace fast -o x.csv"},
          Case{"x.state", "stream --in press --pace fast -o /dev/null --save-state x.state"}, Case{"x.md", "study fig3 --markdown x.md"},
          Case{"x.html", "study fig3 --report x.html"}}) {
        const TemporaryFolder folder;
        folder.write("a.cir", small_deck);
        fs::create_directory(folder / "own");
        folder.write(c.file, "time,force\n0,1\n");
        const auto refused = test::run_program(folder, c.arguments);
        EXPECT_EQ(refused.status, 1) << c.arguments;
        EXPECT_NE(refused.err.find("this file was not written by corpuscle"), std::string::npos) << c.arguments << '\n' << refused.err;
        EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
        EXPECT_EQ(read_file(folder / c.file), "time,force\n0,1\n") << c.arguments;
        EXPECT_EQ(test::run_program(folder, std::string(c.arguments) + " --overwrite -q").status, 0) << c.arguments;
        EXPECT_NE(fs::exists(folder / c.file) ? read_file(folder / c.file) : "", "time,force\n0,1\n") << c.arguments;
    }
}

TEST(Outputs, ThatOnlyLookLikeOursAreNotReplaced) {
    const TemporaryFolder folder;
    folder.write("a.cir", small_deck);
    const std::pair<const char*, const char*> others[] = {
        {"run a.cir -o x.csv", "time,Force(N)\n0,1\n"},
        {"run a.cir -o x.csv", "TIME,V(OUT)\n0,1\n"},
        {"run a.cir -o x.csv", "time,load(kg)\n0,1\n"},
        {"stream --in press --pace fast -o x.csv --format jsonl", "{\"time_s\":0.0,\"fz_N\":0}\n"},
        {"stream --in press --pace fast -o x.csv --format jsonl", "{\"time_s\":0.123456789,\"fz_N\":0}\n"},
        {"stream --in press --pace fast -o x.csv", "afferent,channel,time_s\nsa1,thumb,0.25\n"},
    };
    for (const auto& [arguments, text] : others) {
        folder.write("x-1.csv", text), folder.write("x.csv", text);
        const auto ran = test::run_program(folder, arguments);
        EXPECT_EQ(ran.status, 1) << arguments << '\n' << text;
        EXPECT_NE(ran.err.find("this file was not written by corpuscle"), std::string::npos) << ran.err;
        EXPECT_EQ(read_file(folder / "x.csv"), text) << arguments;
        EXPECT_EQ(read_file(folder / "x-1.csv"), text) << arguments;
    }
}

TEST(Outputs, NeverReplaceADeviceOrAPipe) {
    const TemporaryFolder folder;
    folder.write("b.cir", "small\nv1 in 0 1\nr1 in 0 1k\n.tran 10u 1m\n");
    for (const std::string name : {"a.csv", "a.raw"}) {
        const auto pipe = folder / name;
        ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        std::thread reader([&] { std::system(("timeout 20 cat '" + pipe + "' >'" + (folder / "got") + "'").c_str()); });
        const auto ran = test::run_program(folder, "run b.cir -q -o " + name);
        reader.join();
        EXPECT_TRUE(fs::is_fifo(pipe)) << name;
        EXPECT_FALSE(read_file(folder / "got").empty()) << name;
        EXPECT_EQ(ran.status, name == "a.csv" ? 0 : 1) << ran.err;
        EXPECT_EQ(ran.err.find("is a pipe") != std::string::npos, name == "a.raw") << "its header is completed last: " << ran.err;
    }
    if (::geteuid() != 0) return;
    ASSERT_EQ(::mknod((folder / "null.raw").c_str(), S_IFCHR | 0600, makedev(1, 3)), 0);
    ASSERT_EQ(::mknod((folder / "full.raw").c_str(), S_IFCHR | 0600, makedev(1, 7)), 0);
    EXPECT_EQ(test::run_program(folder, "run b.cir -q -o null.raw").status, 0);
    EXPECT_EQ(test::run_program(folder, "run b.cir -q -o full.raw").status, 1) << "the disk is full";
    for (const auto* name : {"null.raw", "full.raw"}) EXPECT_TRUE(fs::is_character_file(folder / name)) << name;
}

TEST(Outputs, OfTheSameCommandAreReplacedWithoutAnOption) {
    const TemporaryFolder folder;
    folder.write("a.cir", small_deck);
    folder.write("f.csv", recording_text());
    for (const std::string arguments :
         {"respond press -o answer --probe-files --npz --bin 10ms --wav --report", "respond press -o answer --vectors -a sa1-kim",
          "respond f.csv -o answer", "respond press --population 'grid 4x4' -o answer --report --events aer",
          "respond press --report page.html", "respond press --report", "run a.cir -o x.csv", "run a.cir -o x.raw",
          "run a.cir -o y.raw --ascii", "export a.cir -o x.cir", "study fig3 --report s.html --markdown s.md",
          "stream --in press --pace fast -o a.csv --save-state a.state", "stream --in press --pace fast -o a.jsonl --format jsonl",
          "stream --in press --pace fast -o a.aer --format aer", "stream --in press --pace fast -o a.aedat --format aedat2"})
        for (int k = 0; k < 2; ++k) {
            const auto ran = test::run_program(folder, arguments + " -q");
            EXPECT_EQ(ran.status, 0) << arguments << '\n' << ran.err;
        }
    const auto cir = read_file(folder / "a.cir");
    folder.write("a.cir", cir + ".save v(out) i(v1)\n");
    EXPECT_EQ(test::run_program(folder, "run a.cir -o x.csv -q").status, 0) << "other columns of the same netlist";
    folder.write("empty.csv", "");
    EXPECT_EQ(test::run_program(folder, "stream --in press --pace fast -q -o empty.csv").status, 0) << "an empty file may be replaced";
}

TEST(Outputs, OfOneCommandMustBeDifferentFiles) {
    const TemporaryFolder folder;
    const auto ran = test::run_program(folder, "stream --in press --pace fast -o x.csv --save-state ./x.csv");
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.err.find("two outputs of this command have this name"), std::string::npos) << ran.err;
    EXPECT_TRUE(folder.file_names().empty());
}

TEST(Outputs, AForgedSummaryRemovesAndReplacesNoFile) {
    const TemporaryFolder folder;
    for (const char* name : {"thesis.tex", "vectors.csv", "traces-x.csv", "notes.html", "target.csv"}) folder.write(name, "mine");
    fs::create_directory(folder / "d");
    for (const char* name : {"thesis.tex", "notes.html"}) folder.write(std::string("d/") + name, "mine");
    fs::create_symlink("../target.csv", folder / "d/psth.csv");
    folder.write("d/summary.json",
                 R"({"program":"corpuscle","files":["thesis.tex","../thesis.tex","notes.html","psth.csv","../vectors.csv",".",""]})");
    const auto ran = test::run_program(folder, "respond press -o d");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.out.find("Removed"), std::string::npos) << ran.out;
    for (const char* name : {"thesis.tex", "vectors.csv", "traces-x.csv", "notes.html", "target.csv", "d/thesis.tex", "d/notes.html"})
        EXPECT_EQ(read_file(folder / name), "mine") << name;
    EXPECT_TRUE(fs::is_symlink(folder / "d/psth.csv"));
}

TEST(Outputs, AnInputThatAnEarlierRunWroteIsNotRemoved) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::run_program(folder, "respond press --probe-files -o . -q").status, 0);
    const auto ran = test::run_program(folder, "respond probes.csv --channel 1 -o .");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(fs::exists(folder / "probes.csv"));
    EXPECT_EQ(ran.out.find("Removed"), std::string::npos) << ran.out;
}

TEST(Outputs, OfAKilledRunAreRemovedByTheNextRun) {
    const TemporaryFolder folder;
    const auto begin = [&](std::vector<std::string> options) {
        const pid_t child = test::fork_child();
        if (child != 0) return child;
        options.insert(options.begin(), test::program_path());
        std::vector<char*> arguments;
        for (auto& w : options) arguments.push_back(w.data());
        arguments.push_back(nullptr);
        if (::chdir(folder.path().c_str()) == 0) ::execv(arguments[0], arguments.data());
        std::_Exit(99);
    };
    const auto partial_file_count = [&] {
        int count = 0;
        for (const auto& name : folder.file_names()) count += name.find(".part-") != name.npos;
        return count;
    };
    const auto long_run =
        begin({"respond", "sine", "--set", "sine.duration=100000s", "--rate", "100kHz", "--probe-files", "-q", "-o", "a"});
    for (int k = 0; k < 500 && partial_file_count() < 3; ++k) ::usleep(10000);
    EXPECT_EQ(partial_file_count(), 3);
    EXPECT_EQ(test::run_program(folder, "respond press -o a -q").status, 0) << "while another run writes there";
    EXPECT_EQ(partial_file_count(), 3) << "files in use are kept";
    test::signal_child(long_run, SIGKILL);
    ::waitpid(long_run, nullptr, 0);
    folder.write("a/mine.csv.part-3", "mine");
    folder.write("a/spikes.csv.part-iii", "mine");
    EXPECT_EQ(test::run_program(folder, "respond press -o a -q").status, 0);
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"a", "mine.csv.part-3", "spikes.csv", "spikes.csv.part-iii", "summary.json"}));
}

TEST(Outputs, PartialFilesDoNotFollowLinks) {
    const TemporaryFolder folder;
    folder.write("victim", "mine");
    const auto part = fmt::format("x.csv.part-{}", ::getpid());
    fs::create_symlink("victim", folder / part);
    auto file = test::value_or_throw(OutputFile::create(folder / "x.csv"));
    ASSERT_TRUE(file.write("1\n"));
    ASSERT_TRUE(file.commit());
    EXPECT_EQ(read_file(folder / "x.csv"), "1\n");
    fs::create_symlink("victim", folder / "y.csv.part");
    const auto growing = OutputFile::create_growing(folder / "y.csv");
    ASSERT_FALSE(growing);
    EXPECT_NE(growing.error().text().find("is a link or not a regular file"), std::string::npos) << growing.error().text();
    EXPECT_EQ(read_file(folder / "victim"), "mine");
    fs::create_symlink("victim", folder / "r.sqlite-writer");
    folder.write("s.toml", "afferent = \"sa1\"\nforce = \"press\"\n[[vary]]\nwhat = \"sa1.f_B\"\nlist = [\"20 Hz\", \"21 Hz\"]\n");
    const auto sweep = test::run_program(folder, "sweep s.toml -o r.sqlite -q");
    EXPECT_EQ(sweep.status, 1);
    EXPECT_NE(sweep.err.find("is a link"), std::string::npos) << sweep.err;
    EXPECT_EQ(read_file(folder / "victim"), "mine");
}

TEST(Outputs, ThatTookMoreThanASecondOrAreForResumingAreSyncedBeforeTheyAreRenamed) {
    const TemporaryFolder folder;
    auto quick = test::value_or_throw(OutputFile::create(folder / "quick.csv")),
         for_resuming = test::value_or_throw(OutputFile::create(folder / "x.state")),
         slow = test::value_or_throw(OutputFile::create(folder / "slow.csv"));
    ASSERT_TRUE(quick.commit());
    ASSERT_TRUE(for_resuming.commit(SyncPolicy::always));
    ::usleep(1'050'000);
    ASSERT_TRUE(slow.commit());
    EXPECT_FALSE(quick.is_synced());
    EXPECT_TRUE(for_resuming.is_synced());
    EXPECT_TRUE(slow.is_synced());
    EXPECT_TRUE(sync_directory_of(folder / "slow.csv"));
}

/// True if the file system has not yet allocated blocks for the file; empty if it does not report that.
std::optional<bool> is_allocation_delayed(const std::string& path) {
    alignas(::fiemap) char buffer[sizeof(::fiemap) + 8 * sizeof(::fiemap_extent)] = {};
    auto* const map = reinterpret_cast<::fiemap*>(buffer);
    map->fm_length = FIEMAP_MAX_OFFSET, map->fm_extent_count = 8;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool done = file >= 0 && ::ioctl(file, FS_IOC_FIEMAP, map) == 0;
    ::close(file);
    if (!done || map->fm_mapped_extents == 0) return {};
    for (unsigned k = 0; k < map->fm_mapped_extents; ++k)
        if ((map->fm_extents[k].fe_flags & FIEMAP_EXTENT_DELALLOC) != 0) return true;
    return false;
}

TEST(Outputs, OfAShortRunAreBeingWrittenToDiskWhenTheyAreRenamed) {
    const TemporaryFolder folder;
    const std::string text(100'000, 'x');
    if (is_allocation_delayed(folder.write("plain", text)) != true) GTEST_SKIP() << "the file system does not report delayed allocation";
    auto quick = test::value_or_throw(OutputFile::create(folder / "quick.csv"));
    ASSERT_TRUE(quick.write(text));
    ASSERT_TRUE(quick.commit());
    EXPECT_EQ(is_allocation_delayed(folder / "quick.csv"), false);
}

TEST(Outputs, ADeviceIsWrittenInPlace) {
    auto file = test::value_or_throw(OutputFile::create("/dev/null"));
    EXPECT_TRUE(file.write("x"));
    EXPECT_TRUE(file.commit());
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(Outputs, AFullDiskBehindStandardOutputIsAnError) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const TemporaryFolder folder;
    folder.write("a.cir", small_deck);
    ASSERT_EQ(test::run_program(folder, "respond press -o a -q").status, 0);
    for (const std::string arguments :
         {"respond press", "respond press --json", "respond press --population 'grid 4x4'", "run a.cir", "run a.cir --json", "study fig3",
          "compare a/spikes.csv a/spikes.csv", "export a.cir", "list", "list --json", "--help", "--version"}) {
        const auto status =
            std::system(("cd '" + folder.path() + "' && '" + test::program_path() + "' " + arguments + " >/dev/full 2>err").c_str());
        EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
        EXPECT_NE(read_file(folder / "err").find("cannot write all of standard output: No space left on device"), std::string::npos)
            << arguments;
    }
}

TEST(Outputs, AFileBeyondTheSizeLimitIsAnErrorAndLeavesNoFile) {
    const TemporaryFolder folder;
    const auto status = std::system(
        ("cd '" + folder.path() + "' && (ulimit -f 8; exec '" + test::program_path() + "' respond press --probe-files -o big -q) 2>err")
            .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_EQ(read_file(folder / "err"), "corpuscle: big/probes.csv: could not be written completely: File too large\n");
    EXPECT_EQ(folder.file_names(), std::vector<std::string>{"err"});
}

}  // namespace
}  // namespace corpuscle
